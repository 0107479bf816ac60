#include "rollwave/contact/contact_patch.h"

#include "rollwave/scene/scene.h"

#include <deal.II/base/numbers.h>
#include <deal.II/base/point.h>
#include <deal.II/base/polynomial.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// The contact nodes in the order of their angles.
struct Profile {
  const Scene& scene;
  const Road& road;
  std::vector<double> angle;
  Vector<double> gap, pressure;
  const std::vector<double>& cell_ratio;
  double end_shift; ///< how far an end is behind a node that enters contact, in edges

  bool has_node(int i) const { return 0 <= i && i < int(angle.size()); }

  /// False for the tangent of a drum and beyond.
  bool is_over_road(double z) const {
    return !road.is_convex() ||
           std::abs(from_lowest_point(z)) < road.tangent_angle() - angular_round_off;
  }

  bool zone_is_whole_circle() const {
    return scene.zone_end - scene.zone_begin > 2 * numbers::PI - angular_round_off;
  }

  /// How far an end is behind the node @p i when this enters contact, an angle.
  double shift(int i) const {
    if (!has_node(i - 1) || !has_node(i + 1))
      return 0;
    const double before = angle[i] - angle[i - 1], after = angle[i + 1] - angle[i];
    return std::min({end_shift * (before + after) / 2, before / 2, after / 2});
  }

  /// The last angle in the direction @p out (-1 or 1) at which contact can end: that of the zone,
  /// or of the tangent of a drum.
  double reach(int out) const {
    return out < 0 ? std::max(scene.zone_begin, lowest_point - road.tangent_angle())
                   : std::min(scene.zone_end, lowest_point + road.tangent_angle());
  }
};

/// The first and the last node of a stretch of contact.
struct Stretch {
  int first, last;
};

/// An end of a stretch; @p edge is the length of the mesh's edge there, an angle.
struct PatchEnd {
  double angle;
  double uncertainty;
  double edge;
  bool is_cut = false; ///< by the zone
};

/// The x in [0, 1] at which x near / ((1 - x) far_first + x far_last) has the value @p ratio.
double fraction(double ratio, double near, double far_first, double far_last) {
  const double denominator = near - ratio * (far_last - far_first);
  return denominator > 0 ? std::clamp(ratio * far_first / denominator, 0., 1.) : 1;
}

/// The exponent s of the end laws at distances of @p spacing.
double end_exponent(const Scene& scene, double spacing) {
  const double margin = std::max(0., 1 - scene.angular_velocity * scene.outer_radius);
  return spacing > std::pow(2 * margin, 1.5) ? 1. / 3 : 1. / 2;
}

/// The end of a stretch next to its outermost node @p i, in the direction @p out (-1 or 1).
PatchEnd find_end(const Profile& nodes, int i, int out) {
  const auto& z = nodes.angle;
  const int near = i + out, far = near + out, inner = i - out;
  const double reach = nodes.reach(out);
  const double neighbour = nodes.has_node(near)    ? z[near]
                           : nodes.has_node(inner) ? z[inner]
                                                   : reach;
  const double edge = std::abs(neighbour - z[i]), s = end_exponent(nodes.scene, edge);
  // Distances are from the node i. The end is at first when i enters contact, and at last when the
  // next node does.
  const auto distance = [&](int k) { return std::abs(z[k] - z[i]); };
  const double room = std::abs(reach - z[i]), first = -nodes.shift(i),
               last = nodes.has_node(near) ? edge - nodes.shift(near) : room;
  const auto pressure_at = [&](double d) { return std::pow(d, 1 - s); };
  const auto gap_at = [&](double d) { return std::pow(d, 1 + s); };

  std::optional<double> by_pressure, by_gap;
  if (nodes.has_node(inner) && nodes.pressure[inner] > 0)
    by_pressure =
        fraction(nodes.pressure[i] / nodes.pressure[inner], pressure_at(last),
                 pressure_at(distance(inner) + first), pressure_at(distance(inner) + last));
  if (nodes.has_node(far) && nodes.is_over_road(z[far]) && nodes.gap[far] > 0)
    by_gap = fraction(nodes.gap[near] / nodes.gap[far], gap_at(edge - first),
                      gap_at(distance(far) - last), gap_at(distance(far) - first));
  if (!nodes.has_node(near)) {
    // A pressure that is singular at the end of the zone does not fall towards it.
    if (nodes.is_over_road(reach) && !(by_pressure && *by_pressure < 1))
      return {reach, 0, edge, !nodes.zone_is_whole_circle()};
    return {z[i] + out * (first + room) / 2, (room - first) / 2, edge};
  }
  const double p = by_pressure.value_or(0.5), g = by_gap.value_or(0.5);
  const double t = p + g > 0 ? p / (p + g) : 0.5;
  const double share = (by_pressure && by_gap ? 0.2 : 0.5) + std::abs(1 - p - g) / 2;
  return {z[i] + out * std::min(first + t * (last - first), room),
          edge * share * std::max(1., nodes.cell_ratio[i] / 2), edge};
}

/// The stretches of active nodes: two of them are apart where the gap of a node between them is
/// larger than @p negligible_gap.
std::vector<Stretch> find_stretches(const std::vector<bool>& active, const Profile& nodes,
                                    double negligible_gap) {
  std::vector<Stretch> stretches;
  double opening = 0; // the largest gap of the nodes since the last active one
  for (int i = 0; i < int(active.size()); ++i) {
    if (!active[i]) {
      opening = std::max(opening, nodes.gap[i]);
      continue;
    }
    if (stretches.empty() || opening > negligible_gap)
      stretches.push_back({i, i});
    else
      stretches.back().last = i;
    opening = 0;
  }
  return stretches;
}

/// The numbers of a stretch with its ends.
ContactPatch measure_patch(const Profile& nodes, const Vector<double>& force,
                           const Stretch& stretch, PatchEnd begin, PatchEnd end) {
  if (end.angle < begin.angle)
    std::swap(begin, end);
  const auto road_between = [&](double from, double to) {
    return nodes.road.arc_length(from_lowest_point(to)) -
           nodes.road.arc_length(from_lowest_point(from));
  };
  // Farther out the road is steeper.
  const auto road_uncertainty = [&](const PatchEnd& of) {
    const double least = std::max(of.angle - of.uncertainty, nodes.reach(-1)),
                 largest = std::min(of.angle + of.uncertainty, nodes.reach(1));
    return std::max(road_between(least, of.angle), road_between(of.angle, largest));
  };
  ContactPatch patch = {};
  patch.begin = begin.angle;
  patch.begin_uncertainty = begin.uncertainty;
  patch.end = end.angle;
  patch.end_uncertainty = end.uncertainty;
  patch.length = road_between(patch.begin, patch.end);
  patch.length_uncertainty = road_uncertainty(begin) + road_uncertainty(end);
  for (int i = stretch.first; i <= stretch.last; ++i) {
    patch.force += force(i);
    patch.centroid += force(i) * nodes.angle[i];
    patch.peak_pressure = std::max(patch.peak_pressure, nodes.pressure[i]);
  }
  patch.centroid = patch.force > 0 ? patch.centroid / patch.force : nodes.angle[stretch.first];
  return patch;
}

/// The distance of the pressure at the node @p i from the polynomial through those of up to @p n
/// neighbours on each side.
double roughness(const Profile& nodes, int i, int n) {
  std::vector<Point<1>> points;
  std::vector<double> pressures;
  for (int k = i - n; k <= i + n; ++k)
    if (k != i && nodes.has_node(k)) {
      points.emplace_back(nodes.angle[k] - nodes.angle[i]);
      pressures.push_back(nodes.pressure[k]);
    }
  double difference = nodes.pressure[i];
  for (unsigned int k = 0; k < points.size(); ++k)
    difference -= pressures[k] * Polynomials::Polynomial<double>(points, k).value(0);
  return std::abs(difference);
}

/// The error of the pressure at its peak in a @p patch.
double peak_uncertainty(const Profile& nodes, const Stretch& stretch, const ContactPatch& patch,
                        unsigned int degree) {
  const auto begin = nodes.pressure.begin();
  const int peak = std::max_element(begin + stretch.first, begin + stretch.last + 1) - begin;
  double roughest = 0;
  for (const int i : {peak - 1, peak, peak + 1})
    if (nodes.has_node(i))
      roughest = std::max(roughest, roughness(nodes, i, (degree + 1) / 2));
  const double relative_length = patch.half_width_uncertainty() / patch.half_width();
  return roughest + patch.peak_pressure * relative_length * relative_length;
}

} // namespace

double ContactPatch::half_width() const {
  return (end - begin) / 2;
}

double ContactPatch::half_width_uncertainty() const {
  return (begin_uncertainty + end_uncertainty) / 2;
}

double ContactResultants::sum(const std::function<double(const ContactPatch&)>& number) const {
  double sum = 0;
  for (const ContactPatch& patch : patches)
    sum += number(patch);
  return sum;
}

ContactResultants measure_contact(const Scene& scene, const ContactProblem& problem,
                                  const ContactSolution& solution, unsigned int degree) {
  const auto& [displacement, force, kept] = solution.state;
  Profile profile = {scene,
                     problem.road,
                     {},
                     problem.gaps(displacement),
                     problem.pressures(force),
                     problem.cell_ratio,
                     degree == 1 ? 1. / 3 : 1. / 5};
  for (const double x : problem.x)
    profile.angle.push_back(lowest_point + x);
  ContactResultants resultants = {};
  resultants.loads = loads_of(problem, force);
  resultants.active_nodes = std::count(solution.active.begin(), solution.active.end(), true);
  resultants.peak_pressure_uncertainty = 0;
  double moving = 0; // by how much all ends may move
  const double negligible_gap = std::max(solution.gap_accuracy, 1e-10 * displacement.linfty_norm());
  for (const Stretch& stretch : find_stretches(solution.active, profile, negligible_gap)) {
    const PatchEnd begin = find_end(profile, stretch.first, -1),
                   end = find_end(profile, stretch.last, 1);
    const ContactPatch patch = measure_patch(profile, force, stretch, begin, end);
    resultants.patches.push_back(patch);
    for (const PatchEnd& one : {begin, end})
      moving += one.is_cut ? one.edge : one.uncertainty;
    if (patch.peak_pressure >= resultants.peak_pressure) {
      resultants.peak_pressure = patch.peak_pressure;
      resultants.peak_pressure_uncertainty.reset();
      if (!begin.is_cut && !end.is_cut)
        resultants.peak_pressure_uncertainty = peak_uncertainty(profile, stretch, patch, degree);
    }
  }
  if (const auto& patches = resultants.patches; !patches.empty()) {
    resultants.ends = std::pair(patches.front().begin, patches.back().end);
    resultants.relative_stiffness_uncertainty = moving / 2 / (2 * resultants.half_width());
  }
  return resultants;
}

} // namespace rollwave
