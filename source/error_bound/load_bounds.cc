#include "rollwave/error_bound/load_bounds.h"

#include "rollwave/scene/scene.h"

#include <deal.II/base/numbers.h>

#include <cmath>

namespace rollwave {

using dealii::numbers::PI;

LoadFunction::LoadFunction(const Scene& scene, unsigned int k)
    : k(k), outer_radius(scene.outer_radius),
      mode(scene.inner_radius, scene.outer_radius, scene.angular_velocity, k) {}

double LoadFunction::on_surface(double z) const {
  return std::cos(k * from_lowest_point(z));
}

double LoadFunction::norm_squared() const {
  return flux() * (k == 0 ? 2 * PI : PI);
}

LoadFunctions load_functions(const Scene& scene) {
  return {{LoadFunction(scene, 0), LoadFunction(scene, 1)}};
}

Interval bound_load(const LoadFunction& w, const LoadIntegrals& integrals, double radius,
                    double size, double round_off) {
  const double norm = std::sqrt(w.norm_squared()), pressure = integrals.pressure;
  const double mean = (integrals.work_of_force - w.flux() * integrals.trace + pressure) / 2;
  const double half_width = radius * norm + round_off * (size * norm + std::abs(pressure));
  return {mean - half_width, mean + half_width};
}

} // namespace rollwave
