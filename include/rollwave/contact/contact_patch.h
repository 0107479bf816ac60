#pragma once

#include "rollwave/contact/contact_problem.h"

#include <optional>
#include <utility>
#include <vector>

namespace rollwave {

/// One stretch of the surface in contact.
struct ContactPatch {
  double begin; ///< an angle
  double end;
  double force;    ///< b int lambda dz over the stretch
  double centroid; ///< int lambda z dz / int lambda dz, an angle
  double peak_pressure;
  double length = 0; ///< of the road under it
};

/// Resultants of the contact. Forces are per unit length of the axle and unit shear
/// modulus, so that they are lengths, like the displacement.
struct ContactResultants {
  std::vector<ContactPatch> patches; ///< by increasing angle

  /// Where the first patch begins and the last one ends; nullopt without contact.
  std::optional<std::pair<double, double>> ends;
  Loads loads;
  std::optional<Loads> stiffness = {}; ///< -d/dc of the three, see contact_stiffness()
  double peak_pressure;                ///< max lambda_i
  unsigned int active_nodes;

  /// Half of the length in contact, an angle.
  double half_width() const;

  /// The nip: the length of road under all patches.
  double length() const;
};

/**
 * Resultants by the rule [.,.]_h of SurfaceNode and the ends of each patch.
 *
 * Outside of an end, at the distance d, the gap grows like d^(1+s), and inside the pressure like
 * d^(1-s), with s = 1/2 below the critical speed and s = 1/3 at it. So gap^(1/(1+s)) is linear in
 * z, and its root is the end: a straight line through the second and the fourth node outside (the
 * first carries the error of the end cell). If there are fewer nodes, the first two are used. If
 * that fails, the pressure inside is. Where the zone cuts the contact short, the end is the zone's;
 * no end lies beyond the zone or the tangent of a drum.
 * With e = 1 - omega b > 0 small, s = 1/3 is the law at distances greater than (2 e)^(3/2) and is
 * used when the nodes are further apart than that.
 *
 * Two patches are apart where a node between them is not in contact and its gap is more than
 * ContactSolution::gap_accuracy and round-off.
 */
ContactResultants measure_contact(const Scene& scene, const std::vector<SurfaceNode>& nodes,
                                  const ContactProblem& problem, const ContactSolution& solution);

} // namespace rollwave
