#include "rollwave/exact/exact_field.h"

#include "rollwave/scene/uniform_force.h"

#include <deal.II/base/numbers.h>

#include <cmath>
#include <cstddef>

namespace rollwave {

using namespace dealii;

ExactField::ExactField(const ExactScene& scene, const ExactSolution& solution, unsigned int n_modes)
    : scene(scene), modes(scene.inner_radius, scene.outer_radius, scene.angular_velocity) {
  for (unsigned int k = 0; k < n_modes; ++k)
    amplitudes.push_back(-(k == 0 ? 1 : 2) * modes.compliance(k) *
                         solution.pressure.fourier_integral(k).real() / (2 * numbers::PI));
}

ExactField::Value ExactField::operator()(double r, double z) const {
  const double a = scene.inner_radius, b = scene.outer_radius, f = scene.force_density;
  Value value{scene.contact_free_displacement(r), f * (b - r) * (b + r) / (2 * r), 0};
  const double x = from_lowest_point(z);
  for (unsigned int k = 0; k < amplitudes.size(); ++k) {
    double radial = 1, slope = 0;
    if (r < b) {
      const BesselModes::Profile profile = modes.profile(k, {r});
      radial = profile.value[0];
      slope = profile.derivative[0];
    } else
      slope = 1 / modes.compliance(k);
    value.displacement += amplitudes[k] * radial * std::cos(k * x);
    value.radial_derivative += amplitudes[k] * slope * std::cos(k * x);
    value.angular_derivative -= amplitudes[k] * radial * k * std::sin(k * x);
    if (k * log_of_ratio(r, a) > 1 && std::abs(radial) < 1e-18)
      break;
  }
  return value;
}

std::vector<std::vector<double>>
ExactField::cosine_coefficients(const std::vector<double>& radii) const {
  std::vector<std::vector<double>> coefficients;
  for (const double r : radii)
    coefficients.push_back({scene.contact_free_displacement(r)});
  std::size_t first = 0; // of the radii at which modes still matter
  for (unsigned int k = 0; k < amplitudes.size() && first < radii.size(); ++k) {
    const auto profile = modes.profile(k, {radii.begin() + first, radii.end()}).value;
    for (std::size_t i = first; i < radii.size(); ++i)
      if (k == 0)
        coefficients[i][0] += amplitudes[0] * profile[i - first];
      else
        coefficients[i].push_back(amplitudes[k] * profile[i - first]);
    for (const double value : profile)
      if (k * log_of_ratio(radii[first], scene.inner_radius) >= 1 && std::abs(value) <= 1e-9)
        ++first;
      else
        break;
  }
  return coefficients;
}

} // namespace rollwave
