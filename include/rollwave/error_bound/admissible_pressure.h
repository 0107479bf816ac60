#ifndef ROLLWAVE_ERROR_BOUND_ADMISSIBLE_PRESSURE_H
#define ROLLWAVE_ERROR_BOUND_ADMISSIBLE_PRESSURE_H

#include <vector>

namespace rollwave {

class RingSpace;
struct ContactSolution;
struct Scene;

/// A contact pressure on one edge, linear in the coordinate t from 0 at its begin to 1 at its end:
/// lambda(t) = mean + slope (t - 1/2).
struct EdgePressure {
  double mean;
  double slope;

  double operator()(double t) const { return mean + slope * (t - 0.5); }
};

/**
 * The pressures of the certificate, one for each of RingSpace::surface_faces(): zero on edges that
 * lie not wholly in the zone; on the others their sum is the discrete contact force.
 *
 * Each has the mean of the discrete pressure and, but for degree 1, the difference of its values at
 * the vertices, at most 2 mean, for degree 2 3 mean: as far as lambda >= 0, for degree 2 with the
 * multiple of angular_mode() that makes it 3 t^2 mean at the limit.
 *
 * Where contact ends at a vertex, half of this node's force, more or less, would lie on the edge
 * outside, under the gap. Let the pressure go on, in the straight line through the last two nodes
 * in contact, to its root and, negative, beyond. The edge outside gets the multiple of (1 - t)^q
 * nearest to that line in the mean square, t counted from contact, unless it had less, and the
 * edge inside the rest of the force; q is 0, 2, 1 for degrees 1, 2 and above. In rings that are so
 * thin that the surface answers like an elastic foundation the line is -phi times its stiffness.
 */
std::vector<EdgePressure> admissible_pressures(const RingSpace& space, const Scene& scene,
                                               const ContactSolution& contact);

} // namespace rollwave

#endif
