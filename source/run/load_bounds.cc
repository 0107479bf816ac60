#include "rollwave/run/load_bounds.h"

#include "rollwave/error_bound/error_bound.h"
#include "rollwave/scene/scene.h"

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

namespace {

/// The certified bounds of E at another distance, on the same mesh.
Bounds certified_energy(const RunOptions& options, const RingSpace& space,
                        const MeshSolution& solution, double distance, MeshCache& system,
                        Work& work) {
  Scene moved = with_distance(solution.scene, distance);
  moved.load.reset();
  const Vector<double> start = solution.problem.pressures(solution.contact.state.force);
  const MeshSolution there = solve_on_mesh(moved, options, space, start, system, work);
  const CertifiedError error =
      certify(space, moved, there.problem, there.contact, there.displacement, system.force.get(),
              system.dual_of(moved, space, work), work)
          .error;
  return {error.lower_bound, error.upper_bound};
}

/// The step at which the two widths of the bounds of G are equal.
double best_step(const Scene& scene, const CertifiedError& here, double stiffness) {
  const double step = stiffness > 0
                          ? std::sqrt(2 * (here.upper_bound - here.lower_bound) / stiffness)
                          : 1e-3 * (scene.outer_radius - scene.inner_radius);
  return std::min(step, (scene.road_distance - scene.inner_radius) / 2);
}

} // namespace

Bounds bound_load(const RunOptions& options, const RingSpace& space, const MeshSolution& solution,
                  MeshCache& system, Result& result) {
  const CertifiedError here = *result.certified;
  const auto energy = [&](double distance) {
    return certified_energy(options, space, solution, distance, system, result.work);
  };
  const double c = solution.scene.road_distance;
  const double step = best_step(solution.scene, here, solution.stiffness.work_conjugate);
  const Bounds near = energy(c - step), far = energy(c + step);
  return {std::max(0., (here.lower_bound - far.upper) / step),
          (near.upper - here.lower_bound) / step};
}

std::optional<Bounds> bound_distance(const RunOptions& options, const RingSpace& space,
                                     const MeshSolution& solution, MeshCache& system,
                                     Result& result) {
  const CertifiedError here = *result.certified;
  const auto energy = [&](double distance) {
    return certified_energy(options, space, solution, distance, system, result.work);
  };
  const double c = solution.scene.road_distance, load = solution.scene.load->value;
  for (double step = 1.5 * best_step(solution.scene, here, solution.stiffness.work_conjugate);
       step < 0.01 * c; step *= 2) {
    const Bounds near = energy(c - step), far = energy(c + step);
    if ((here.upper_bound - far.lower) / step <= load &&
        load <= (near.lower - here.upper_bound) / step)
      return Bounds{c - step, c + step};
  }
  return {};
}

} // namespace rollwave
