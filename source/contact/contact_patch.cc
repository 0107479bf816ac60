#include "rollwave/contact/contact_patch.h"

#include "rollwave/scene/scene.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

namespace {

/// The contact nodes in the order of their angles.
struct Profile {
  std::vector<double> angle;
  Vector<double> gap, pressure;
};

/// A stretch of contact: its first and last node, and the number of free nodes on each side, shared
/// with the next stretch.
struct Stretch {
  int first, last;
  int n_before, n_after;
};

/// Where the line through (z0, value0^power) and (z1, value1^power) is zero; nullopt unless the
/// values grow from a positive value0 to value1.
std::optional<double> root(double z0, double value0, double z1, double value1, double power) {
  if (!(0 < value0 && value0 < value1))
    return {};
  const double ratio = std::pow(value1 / value0, power);
  return z0 - (z1 - z0) / (ratio - 1);
}

/// The exponent s of the end laws at distances of @p spacing.
double end_exponent(const Scene& scene, double spacing) {
  const double margin = std::max(0., 1 - scene.angular_velocity * scene.outer_radius);
  return spacing > std::pow(2 * margin, 1.5) ? 1. / 3 : 1. / 2;
}

/// The end of a stretch next to its outermost node @p i, with @p n_outside nodes in the direction
/// @p out (-1 or 1) and @p n_inside more nodes of the stretch in the other.
double find_end(const Scene& scene, const Profile& nodes, int i, int out, int n_outside,
                int n_inside) {
  const auto& z = nodes.angle;
  const double spacing = std::abs(z[i] - z[i + out]), s = end_exponent(scene, spacing);
  const auto root_of_gap = [&](int near, int far) {
    const int k = i + near * out, l = i + far * out;
    return root(z[k], nodes.gap[k], z[l], nodes.gap[l], 1 / (1 + s));
  };
  std::optional<double> end;
  if (n_outside >= 4)
    end = root_of_gap(2, 4);
  if (!end && n_outside >= 2)
    end = root_of_gap(1, 2);
  if (!end && n_inside >= 1)
    end = root(z[i], nodes.pressure[i], z[i - out], nodes.pressure[i - out], 1 / (1 - s));
  const double inner = z[i] - out * spacing / 2, outer = z[i + out] + out * spacing / 2;
  return std::clamp(end.value_or(z[i] + out * spacing / 2), std::min(inner, outer),
                    std::max(inner, outer));
}

/// The stretches of active nodes: two of them are apart where the gap of a node between them is
/// larger than @p negligible_gap.
std::vector<Stretch> find_stretches(const std::vector<bool>& active, const Profile& nodes,
                                    double negligible_gap) {
  const int n = active.size();
  std::vector<Stretch> stretches;
  double opening = 0; // the largest gap of the nodes since the last active one
  for (int i = 0; i < n; ++i) {
    if (!active[i]) {
      opening = std::max(opening, nodes.gap[i]);
      continue;
    }
    if (stretches.empty())
      stretches.push_back({i, i, i, 0});
    else if (opening > negligible_gap) {
      Stretch& before = stretches.back();
      before.n_after = (i - before.last) / 2; // half of the nodes in between
      stretches.push_back({i, i, before.n_after, 0});
    } else
      stretches.back().last = i;
    opening = 0;
  }
  if (!stretches.empty())
    stretches.back().n_after = n - 1 - stretches.back().last;
  return stretches;
}

/// Between which angles contact can end: those of the zone, up to the tangent of a drum.
std::pair<double, double> reach_of(const Scene& scene, const Road& road) {
  const double tangent = road.tangent_angle();
  return {std::max(scene.zone_begin, lowest_point - tangent),
          std::min(scene.zone_end, lowest_point + tangent)};
}

} // namespace

double ContactResultants::half_width() const {
  double sum = 0;
  for (const ContactPatch& patch : patches)
    sum += (patch.end - patch.begin) / 2;
  return sum;
}

double ContactResultants::length() const {
  double sum = 0;
  for (const ContactPatch& patch : patches)
    sum += patch.length;
  return sum;
}

ContactResultants measure_contact(const Scene& scene, const std::vector<SurfaceNode>& nodes,
                                  const ContactProblem& problem, const ContactSolution& solution) {
  const auto& [displacement, force, kept] = solution.state;
  ContactResultants resultants = {};
  resultants.loads = loads_of(problem, force);
  Profile profile = {{}, problem.gaps(displacement), problem.pressures(force)};
  for (unsigned int i = 0; i < nodes.size(); ++i) {
    resultants.active_nodes += solution.active[i];
    profile.angle.push_back(nodes[i].angle);
    resultants.peak_pressure = std::max(resultants.peak_pressure, profile.pressure[i]);
  }
  const auto [least_begin, largest_end] = reach_of(scene, problem.road);
  const double negligible_gap = std::max(solution.gap_accuracy, 1e-10 * displacement.linfty_norm());
  for (const Stretch& stretch : find_stretches(solution.active, profile, negligible_gap)) {
    const auto [first, last, n_before, n_after] = stretch;
    ContactPatch patch = {least_begin, largest_end, 0, 0, 0};
    if (n_before > 0)
      patch.begin =
          std::max(least_begin, find_end(scene, profile, first, -1, n_before, last - first));
    if (n_after > 0)
      patch.end = std::min(largest_end, find_end(scene, profile, last, 1, n_after, last - first));
    if (patch.end < patch.begin)
      std::swap(patch.begin, patch.end);
    patch.length = problem.road.arc_length(from_lowest_point(patch.end)) -
                   problem.road.arc_length(from_lowest_point(patch.begin));
    for (int i = first; i <= last; ++i) {
      patch.force += force(i);
      patch.centroid += force(i) * profile.angle[i];
      patch.peak_pressure = std::max(patch.peak_pressure, profile.pressure[i]);
    }
    patch.centroid = patch.force > 0 ? patch.centroid / patch.force : profile.angle[first];
    resultants.patches.push_back(patch);
  }
  if (const auto& patches = resultants.patches; !patches.empty())
    resultants.ends = std::pair(patches.front().begin, patches.back().end);
  return resultants;
}

} // namespace rollwave
