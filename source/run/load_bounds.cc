#include "rollwave/run/load_bounds.h"

#include "rollwave/error_bound/error_bound.h"
#include "rollwave/scene/scene.h"

#include <algorithm>
#include <cmath>

namespace rollwave {

namespace {

/// The certified bounds of E at another distance, on the same mesh.
Bounds certified_energy(const RunOptions& options, Discretisation& mesh,
                        const MeshSolution& solution, double distance, RunStatistics& statistics) {
  Scene moved = with_distance(solution.scene, distance);
  moved.load.reset();
  const MeshSolution there = solve_on_mesh(moved, options, mesh.candidates,
                                           pressure_profile(solution), mesh.cache, statistics);
  const CertifiedError error = certify(there, mesh.cache, statistics).error;
  return {error.lower_bound, error.upper_bound};
}

/// The step at which the two widths of the bounds of G are equal.
double best_step(const Scene& scene, const CertifiedError& error, double stiffness) {
  const double step = stiffness > 0
                          ? std::sqrt(2 * (error.upper_bound - error.lower_bound) / stiffness)
                          : 1e-3 * (scene.outer_radius - scene.inner_radius);
  return std::min(step, (scene.road.distance - scene.inner_radius) / 2);
}

} // namespace

Bounds bound_load(const RunOptions& options, Discretisation& mesh, const MeshSolution& solution,
                  const CertifiedError& error, RunStatistics& statistics) {
  const auto energy = [&](double distance) {
    return certified_energy(options, mesh, solution, distance, statistics);
  };
  const double c = solution.scene.road.distance;
  const double step =
      best_step(solution.scene, error, *solution.resultants.stiffness->work_conjugate);
  const Bounds near = energy(c - step), far = energy(c + step);
  return {std::max(0., (error.lower_bound - far.upper) / step),
          (near.upper - error.lower_bound) / step};
}

std::optional<Bounds> bound_distance(const RunOptions& options, Discretisation& mesh,
                                     const MeshSolution& solution, const CertifiedError& error,
                                     RunStatistics& statistics) {
  const auto energy = [&](double distance) {
    return certified_energy(options, mesh, solution, distance, statistics);
  };
  const double c = solution.scene.road.distance, load = solution.scene.load->value;
  for (double step =
           1.5 * best_step(solution.scene, error, *solution.resultants.stiffness->work_conjugate);
       step < 0.01 * c; step *= 2) {
    const Bounds near = energy(c - step), far = energy(c + step);
    if ((error.upper_bound - far.lower) / step <= load &&
        load <= (near.lower - error.upper_bound) / step)
      return Bounds{c - step, c + step};
  }
  return {};
}

} // namespace rollwave
