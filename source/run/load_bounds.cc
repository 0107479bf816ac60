#include "rollwave/run/load_bounds.h"

#include "rollwave/error_bound/error_bound.h"
#include "rollwave/scene/road.h"
#include "rollwave/scene/scene.h"

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

LoadBounds bound_load(const Scene& scene, const RunOptions& options, const RingSpace& space,
                      const MeshSolution& solution, MeshCache& system, Result& result) {
  const CertifiedError here = *result.certified;
  const double b = scene.outer_radius, c = scene.road_distance;
  const double w = result.patch.half_width();
  double step = 1e-3 * (b - scene.inner_radius);
  if (w > 0) {
    // The road sinks in by about b w^2.
    const double slope = result.patch.work_conjugate_load / (b * w * w);
    step = std::sqrt(2 * (here.upper_bound - here.lower_bound) / slope);
  }
  step = std::min(step, (c - scene.inner_radius) / 2);

  Vector<double> start(solution.problem.size());
  for (unsigned int i = 0; i < start.size(); ++i)
    start(i) = solution.contact.state.force(i) / solution.problem.weight(i);
  const auto certify_at = [&](double distance) {
    Scene moved = scene;
    moved.road = flat_road(b, distance);
    moved.road_slope = flat_road_slope(distance);
    const MeshSolution there = solve_on_mesh(moved, options, space, start, system, result.work);
    return certify(space, moved, there.problem, there.contact, there.displacement, system.load,
                   system.dual_of(moved, space, result.work), result.work);
  };
  const Certificate near = certify_at(c - step), far = certify_at(c + step);
  return {std::max(0., (here.lower_bound - far.error.upper_bound) / step),
          (near.error.upper_bound - here.lower_bound) / step};
}

} // namespace rollwave
