#include "rollwave/contact/contact_patch.h"

#include "rollwave/scene/scene.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

namespace {

/// The contact nodes in one direction along the surface.
struct Profile {
  std::vector<double> angle;
  std::vector<double> gap;
  std::vector<double> pressure;
  std::vector<bool> active;

  Profile mirrored() const {
    Profile mirror{{angle.rbegin(), angle.rend()},
                   {gap.rbegin(), gap.rend()},
                   {pressure.rbegin(), pressure.rend()},
                   {active.rbegin(), active.rend()}};
    for (double& z : mirror.angle)
      z = -z;
    return mirror;
  }
};

/// Where the line through (z0, value0^power) and (z1, value1^power) is zero; nullopt unless the
/// values grow from a positive value0 to value1.
std::optional<double> root(double z0, double value0, double z1, double value1, double power) {
  if (!(0 < value0 && value0 < value1))
    return {};
  const double ratio = std::pow(value1 / value0, power);
  return z0 - (z1 - z0) / (ratio - 1);
}

/// Where contact begins, or @p zone_begin when it begins with the zone.
double first_end(const Profile& nodes, double zone_begin, double speed_margin) {
  const auto& z = nodes.angle;
  const unsigned int n = z.size();
  const unsigned int i =
      std::find(nodes.active.begin(), nodes.active.end(), true) - nodes.active.begin();
  if (i == 0)
    return zone_begin;

  const double spacing = z[i] - z[i - 1];
  const double s = spacing > std::pow(2 * speed_margin, 1.5) ? 1. / 3 : 1. / 2;
  std::optional<double> end;
  if (i >= 4)
    end = root(z[i - 2], nodes.gap[i - 2], z[i - 4], nodes.gap[i - 4], 1 / (1 + s));
  if (!end && i >= 2)
    end = root(z[i - 1], nodes.gap[i - 1], z[i - 2], nodes.gap[i - 2], 1 / (1 + s));
  if (!end && i + 1 < n)
    end = root(z[i], nodes.pressure[i], z[i + 1], nodes.pressure[i + 1], 1 / (1 - s));
  if (!end)
    end = z[i] - spacing / 2;
  return std::clamp(*end, z[i - 1] - spacing / 2, z[i] + spacing / 2);
}

} // namespace

ContactPatch measure_contact_patch(const Scene& scene, const std::vector<SurfaceNode>& nodes,
                                   const ContactProblem& problem, const ContactSolution& solution) {
  ContactPatch patch = {};
  Profile profile;
  for (unsigned int i = 0; i < nodes.size(); ++i) {
    const double z = nodes[i].angle;
    const double force = solution.state.force(i);
    const double pressure = force / problem.weight(i);
    const double down = std::cos(z - 3 * numbers::PI / 2);
    patch.force += force;
    patch.vertical_load += force * down;
    patch.work_conjugate_load += force / down;
    patch.peak_pressure = std::max(patch.peak_pressure, pressure);
    patch.active_nodes += solution.active[i];
    profile.angle.push_back(z);
    profile.gap.push_back(problem.road(i) - solution.state.displacement(i));
    profile.pressure.push_back(pressure);
    profile.active.push_back(solution.active[i]);
  }
  if (patch.active_nodes > 0) {
    const double speed_margin = std::max(0., 1 - scene.angular_velocity * scene.outer_radius);
    const double left = first_end(profile, scene.zone_begin, speed_margin);
    const double right = -first_end(profile.mirrored(), -scene.zone_end, speed_margin);
    patch.ends = std::pair(std::min(left, right), std::max(left, right));
  }
  return patch;
}

} // namespace rollwave
