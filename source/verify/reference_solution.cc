#include "rollwave/verify/reference_solution.h"

#include "rollwave/base/errors.h"

#include <deal.II/base/numbers.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

std::optional<ExactSolution> find_exact_solution(const Scene& scene) {
  if (scene.has_uneven_force())
    return {};
  const double left = 3 * numbers::PI / 2 - scene.zone_begin;
  const double right = scene.zone_end - 3 * numbers::PI / 2;
  const double narrow = std::min(left, right);
  if (narrow <= 0)
    return {};
  try {
    const ExactSolution exact =
        solve_exactly({scene.inner_radius, scene.outer_radius, scene.angular_velocity,
                       scene.road_distance, scene.uniform_force.value_or(0), narrow});
    if (exact.end_exponent < 0 && std::abs(left - right) > 1e-12)
      return {};
    return exact;
  } catch (const NotSolved&) {
    return {};
  }
}

} // namespace rollwave
