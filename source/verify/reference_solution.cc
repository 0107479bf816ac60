#include "rollwave/verify/reference_solution.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/falling_zero.h"
#include "rollwave/scene/uniform_force.h"

#include <algorithm>
#include <cmath>

namespace rollwave {

std::optional<ExactSolution> find_exact_solution(const Scene& scene, std::string* why_none,
                                                 MPI_Comm communicator) {
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
                       scene.force.uniform.value_or(0), narrow},
                      communicator);
    if (exact.end_exponent < 0 && std::abs(left - right) > 1e-12)
      return give_up("Road/Contact zone cuts the contact short on one side, or unevenly");
    return exact;
  } catch (const Interrupted&) {
    throw;
  } catch (const NotSolved& reason) {
    return give_up(reason.what());
  }
}

namespace {

/// How deep the free surface would lie in a road at the distance @p c; negative above it.
double free_depth(const Scene& scene, double c) {
  return scene.outer_radius - c +
         scene.force.uniform.value_or(0) * contact_free_unit_displacement(scene.inner_radius,
                                                                          scene.outer_radius,
                                                                          scene.outer_radius);
}

} // namespace

std::optional<double> find_exact_distance(const Scene& scene, MPI_Comm communicator) {
  const double wanted = scene.nip ? *scene.nip : scene.load->value;
  // The exact load or nip above the wanted one. Without contact the gap counts as a negative one.
  const auto excess_at = [&](double distance) {
    const Scene moved = with_distance(scene, distance);
    const auto exact = find_exact_solution(moved, nullptr, communicator);
    if (!exact)
      throw NotSolved("no exact solution is known at a distance that the search tries");
    constexpr double accuracy = 3e-11;
    const double reached = scene.nip ? 2 * moved.road.arc_length(exact->half_width)
                                     : exact->loads.of(scene.load->kind),
                 excess = reached - wanted + (reached > 0 ? 0 : free_depth(scene, distance));
    return std::abs(excess) <= accuracy * wanted ? 0 : excess;
  };
  try {
    const double start = scene.road.distance, at_start = excess_at(start);
    // Twice the step if a load grew like the depth, and a nip like its root.
    const double depth = std::abs(free_depth(scene, start)), reached = wanted + at_start,
                 first_step =
                     std::max(2 * depth * (reached > 0 ? std::abs(at_start) / reached : 1) *
                                  (scene.nip ? 2 : 1),
                              1e-9 * start);
    const auto [left, right] =
        falling_zero(excess_at, start, at_start, first_step,
                     {scene.least_distance, scene.road.greatest_distance()}, 1e-11);
    return (left + right) / 2;
  } catch (const Interrupted&) {
    throw;
  } catch (const NotSolved&) {
    return {};
  }
}

std::optional<double> find_exact_stiffness(const Scene& scene, MPI_Comm communicator) {
  const double c = scene.road.distance, depth = free_depth(scene, c);
  if (depth <= 0)
    return {};
  const double step = 1e-3 * depth;
  const auto nearer = find_exact_solution(with_distance(scene, c - step), nullptr, communicator),
             farther = find_exact_solution(with_distance(scene, c + step), nullptr, communicator);
  if (!nearer || !farther)
    return {};
  return (nearer->loads.vertical - farther->loads.vertical) / (2 * step);
}

} // namespace rollwave
