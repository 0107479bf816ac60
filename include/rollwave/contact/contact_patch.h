#pragma once

#include "rollwave/contact/contact_problem.h"

#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace rollwave {

/// One stretch of the surface in contact. Numbers that end in _uncertainty estimate the error of
/// the number before them.
struct ContactPatch {
  double begin; ///< an angle
  double begin_uncertainty;
  double end;
  double end_uncertainty;
  double force;    ///< b int lambda dz over the stretch
  double centroid; ///< int lambda z dz / int lambda dz, an angle
  double peak_pressure;
  double length; ///< of the road under it
  double length_uncertainty;

  /// Half of the length in contact, an angle.
  double half_width() const;
  double half_width_uncertainty() const;
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

  /// nullopt where the zone cuts the contact short: the pressure is unbounded there.
  std::optional<double> peak_pressure_uncertainty;
  double relative_stiffness_uncertainty; ///< of each of the three
  unsigned int active_nodes;

  /// The sum of a number of the patches.
  double sum(const std::function<double(const ContactPatch&)>& number) const;
  double half_width() const { return sum(&ContactPatch::half_width); }

  /// The nip: the length of road under all patches.
  double length() const { return sum(&ContactPatch::length); }
};

/**
 * Resultants by the rule [.,.]_h of SurfaceNode and the ends of each patch.
 *
 * Outside of an end, at the distance d, the gap grows like d^(1+s), and inside the pressure like
 * d^(1-s), with s = 1/2 below the critical speed and s = 1/3 at it. On a mesh, nodes enter contact
 * one by one, and between two such events all pressures and gaps are nearly linear in the position
 * of the end. At an event the end is behind the node that enters, since a node takes part in
 * contact for its surroundings: by a third of the mean of the edges next to it in linear elements,
 * and by a fifth in others, as measured. Let i be the last node in contact and t the part of the
 * way that the end has gone from where i entered to where the next node enters. The laws, taken at
 * both events, give p = t from the pressure of i over that of the node before it, and g = 1 - t
 * from the gap of the first free node over that of the second. The end is where t = p / (p + g). So
 * it depends on these four nodes only, and moves continuously with the road. Where nodes for p or g
 * are missing, 1/2 takes its place. Where the tangent of a drum comes next to i, the end is the
 * middle of what is possible. doc/decisions.md has what was tried besides.
 *
 * The uncertainty of an end is half of |1 - p - g| and 0.2, in edges, or 0.5 in place of 0.2 where
 * p or g is missing; twice as much in cells that are four times as high as wide, and so on, since
 * these see little of what is new at the end. doc/verification.md shows how often that is enough.
 *
 * Where the zone cuts the contact short, the end is the zone's; no end lies beyond the zone or the
 * tangent of a drum.
 * With e = 1 - omega b > 0 small, s = 1/3 is the law at distances greater than (2 e)^(3/2) and is
 * used when the nodes are further apart than that.
 *
 * Near its largest value the pressure is smooth, so that a nodal pressure differs from the
 * polynomial through those of its neighbours, half a degree on each side, as it does from the exact
 * pressure. Errors of the ends act on it by their relative square. The error of the stiffness is in
 * proportion to that of the length; where the zone cuts the contact short, an edge takes the place
 * of the uncertainty of the end.
 *
 * Two patches are apart where a node between them is not in contact and its gap is more than
 * ContactSolution::gap_accuracy and round-off.
 */
ContactResultants measure_contact(const Scene& scene, const ContactProblem& problem,
                                  const ContactSolution& solution, unsigned int degree);

} // namespace rollwave
