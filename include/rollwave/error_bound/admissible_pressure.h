#pragma once

#include <vector>

namespace rollwave {

class ContactBoundary;
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
 * The pressures lambda >= 0 of the certificate, one for each of RingSpace::surface_edges(): zero on
 * edges that do not lie wholly in the zone; on the others their sum is the discrete contact force.
 *
 * Each has the mean of the discrete pressure and the difference of its values at the vertices,
 * limited to 2 mean in size so that lambda >= 0. For degree 1 the slope is zero: the primitive of
 * lambda on r = b is a stress function of this degree. Where contact ends close to a vertex, the
 * edge in contact gets the share of the edge outside, which would lie under the gap.
 */
std::vector<EdgePressure> admissible_pressures(const ContactBoundary& boundary, const Scene& scene,
                                               const ContactSolution& contact);

} // namespace rollwave
