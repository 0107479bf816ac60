#include "manufactured_scene.h"

#include "rollwave/exact/bessel_modes.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rollwave {

using dealii::numbers::PI;

namespace {

/// sum_k (cosine_k cos(k (z - m)) + sine_k sin(k (z - m))) as a function of z.
std::function<double(double)> series(double m, const std::vector<double>& cosine,
                                     const std::vector<double>& sine) {
  return [=](double z) {
    // Clenshaw's recurrence for both series at once
    const double x = z - m, factor = 2 * std::cos(x);
    double c1 = 0, c2 = 0, s1 = 0, s2 = 0;
    for (std::size_t k = cosine.size() - 1; k > 0; --k) {
      const double c = cosine[k] + factor * c1 - c2;
      const double s = sine[k] + factor * s1 - s2;
      c2 = c1, c1 = c;
      s2 = s1, s1 = s;
    }
    return cosine[0] + std::cos(x) * c1 - c2 + std::sin(x) * s1;
  };
}

} // namespace

ManufacturedScene manufacture_scene(double inner_radius, double outer_radius,
                                    double angular_velocity, const GegenbauerPressure& pressure,
                                    double end_exponent, double gap_factor, double zone_margin,
                                    unsigned int n_modes) {
  const BesselModes modes(inner_radius, outer_radius, angular_velocity);
  const double m = pressure.middle(), w = pressure.half_width();

  // u(b, m + x) = sum_k (cosine_k cos(k x) + sine_k sin(k x))
  std::vector<double> cosine(n_modes), sine(n_modes);
  double norm_squared = 0;
  for (unsigned int k = 0; k < n_modes; ++k) {
    const double compliance = modes.compliance(k);
    const double even = pressure.fourier_integral(k).real(),
                 odd = pressure.fourier_integral(k).imag();
    const double both_signs = k == 0 ? 1 : 2;
    cosine[k] = -both_signs * compliance * even / (2 * PI);
    sine[k] = -both_signs * compliance * odd / (2 * PI);
    norm_squared += both_signs * outer_radius * compliance * (even * even + odd * odd) / (2 * PI);
  }
  std::vector<double> slope_cosine(n_modes), slope_sine(n_modes);
  for (unsigned int k = 0; k < n_modes; ++k) {
    slope_cosine[k] = k * sine[k];
    slope_sine[k] = -1. * k * cosine[k];
  }
  const auto surface = series(m, cosine, sine);
  const auto surface_slope = series(m, slope_cosine, slope_sine);

  const double force = outer_radius * pressure.fourier_integral(0).real();
  ManufacturedScene made = {{},
                            {{inner_radius, outer_radius, angular_velocity, {}, 0},
                             w,
                             {force, 0, 0},
                             norm_squared / 2,
                             norm_squared,
                             0, // peak_pressure
                             0,
                             0,
                             0, // accuracies
                             end_exponent,
                             true,
                             pressure}};
  made.scene = {inner_radius,
                outer_radius,
                angular_velocity,
                {},
                {[=](double z) {
                   const double outside = std::max(0., std::abs(z - m) - w);
                   return surface(z) + gap_factor * outer_radius * std::pow(outside, 1.5);
                 },
                 [=](double z) {
                   const double outside = std::max(0., std::abs(z - m) - w);
                   return surface_slope(z) + std::copysign(1.5, z - m) * gap_factor * outer_radius *
                                                 std::sqrt(outside);
                 }},
                m - w - zone_margin,
                m + w + zone_margin};
  return made;
}

} // namespace rollwave
