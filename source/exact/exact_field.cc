#include "rollwave/exact/exact_field.h"

#include "rollwave/exact/bessel_modes.h"
#include "rollwave/scene/uniform_force.h"

#include <deal.II/base/numbers.h>

#include <cmath>
#include <cstddef>
#include <utility>

namespace rollwave {

std::vector<std::vector<double>> cosine_coefficients(const ExactSolution& solution,
                                                     unsigned int n_modes,
                                                     const std::vector<double>& radii) {
  const ExactScene& scene = solution.scene;
  const BesselModes modes(scene.inner_radius, scene.outer_radius, scene.angular_velocity);
  std::vector<std::vector<double>> coefficients;
  for (const double r : radii)
    coefficients.push_back({scene.contact_free_displacement(r)});
  std::size_t first = 0; // of the radii at which modes still matter
  for (unsigned int k = 0; k < n_modes && first < radii.size(); ++k) {
    const double at_surface = -(k == 0 ? 1 : 2) * modes.compliance(k) *
                              solution.pressure.fourier_integral(k).real() /
                              (2 * dealii::numbers::PI);
    const std::vector<double> profile = modes.profile(k, {radii.begin() + first, radii.end()});
    for (std::size_t i = first; i < radii.size(); ++i)
      if (k == 0)
        coefficients[i][0] += at_surface * profile[i - first];
      else
        coefficients[i].push_back(at_surface * profile[i - first]);
    for (const double value : profile)
      if (k * log_of_ratio(radii[first], scene.inner_radius) >= 1 && std::abs(value) <= 1e-9)
        ++first;
      else
        break;
  }
  return coefficients;
}

AngularValue cosine_sum(const std::vector<double>& coefficients, double z) {
  const double x = from_lowest_point(z), factor = 2 * std::cos(x);
  // Clenshaw's recurrence for the sum and for sum_k k c_k sin(k x)
  double first = 0, second = 0, slope_first = 0, slope_second = 0;
  for (std::size_t k = coefficients.size() - 1; k > 0; --k) {
    second = std::exchange(first, coefficients[k] + factor * first - second);
    slope_second =
        std::exchange(slope_first, k * coefficients[k] + factor * slope_first - slope_second);
  }
  return {coefficients[0] + factor / 2 * first - second, -slope_first * std::sin(x)};
}

} // namespace rollwave
