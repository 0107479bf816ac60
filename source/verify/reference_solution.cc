#include "rollwave/verify/reference_solution.h"

#include "rollwave/base/errors.h"
#include "rollwave/scene/uniform_force.h"

#include <algorithm>
#include <cmath>

namespace rollwave {

std::optional<ExactSolution> find_exact_solution(const Scene& scene, std::string* why_none) {
  const auto give_up = [&](const std::string& why) -> std::optional<ExactSolution> {
    if (why_none)
      *why_none = why;
    return {};
  };
  if (scene.force.is_expression())
    return give_up("Cylinder/Radial force is not constant");
  const double left = lowest_point - scene.zone_begin;
  const double right = scene.zone_end - lowest_point;
  const double narrow = std::min(left, right);
  if (narrow <= 0)
    return give_up("Road/Contact zone leaves out the lowest point");
  try {
    const ExactSolution exact =
        solve_exactly({scene.inner_radius, scene.outer_radius, scene.angular_velocity, scene.road,
                       scene.force.uniform.value_or(0), narrow});
    if (exact.end_exponent < 0 && std::abs(left - right) > 1e-12)
      return give_up("Road/Contact zone cuts the contact short on one side, or unevenly");
    return exact;
  } catch (const NotSolved& reason) {
    return give_up(reason.what());
  }
}

std::optional<double> find_exact_distance(const Scene& scene) {
  const auto excess = [&](double c) -> std::optional<double> {
    const auto exact = find_exact_solution(with_distance(scene, c));
    if (!exact)
      return {};
    return exact->loads.of(scene.load->kind) - scene.load->value;
  };
  // The secant method from the distance found on the mesh, which is close. Each exact solution
  // takes about a second.
  constexpr double first_step = 1e-6, tolerance = 1e-11;
  constexpr int most_steps = 20;
  double before = scene.road.distance, c = before * (1 + first_step);
  std::optional<double> excess_before = excess(before);
  for (int step = 0; step < most_steps && excess_before; ++step) {
    const std::optional<double> excess_here = excess(c);
    if (!excess_here)
      return {};
    const double next = c - *excess_here * (c - before) / (*excess_here - *excess_before);
    if (std::abs(next - c) <= tolerance * c)
      return next;
    before = c;
    excess_before = excess_here;
    c = next;
  }
  return {};
}

std::optional<double> find_exact_stiffness(const Scene& scene) {
  const double free = scene.force.uniform.value_or(0) *
                      contact_free_unit_displacement(scene.inner_radius, scene.outer_radius,
                                                     scene.outer_radius),
               depth = scene.outer_radius + free - scene.road.distance;
  if (depth <= 0)
    return {};
  const double c = scene.road.distance, step = 1e-3 * depth;
  const auto nearer = find_exact_solution(with_distance(scene, c - step)),
             farther = find_exact_solution(with_distance(scene, c + step));
  if (!nearer || !farther)
    return {};
  return (nearer->loads.vertical - farther->loads.vertical) / (2 * step);
}

} // namespace rollwave
