#include "rollwave/scene/uniform_force.h"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/log1p.hpp>

#include <cmath>

namespace rollwave {

double log_of_ratio(double outer_radius, double inner_radius) {
  return std::log1p((outer_radius - inner_radius) / inner_radius);
}

double contact_free_unit_displacement(double inner_radius, double outer_radius, double r) {
  const double a = inner_radius, b = outer_radius, x = (r - a) / a;
  if (x > 1)
    return -(r - a) * (r + a) / 4 + b * b / 2 * std::log1p(x);
  // With ln(1 + x) = x + (ln(1 + x) - x) the terms linear in x are summed up first.
  return x / 2 * ((b - a) * (b + a) - a * (r - a) / 2) + b * b / 2 * boost::math::log1pmx(x);
}

double contact_free_unit_work(double inner_radius, double outer_radius) {
  const double a = inner_radius, b = outer_radius;
  if (b > 2 * a) {
    const double square = (b - a) * (b + a);
    return -square * square / 16 + b * b / 2 * (b * b / 2 * log_of_ratio(b, a) - square / 4);
  }
  // r = b e^-t
  return b * b * b * b / 4 *
         boost::math::quadrature::gauss<double, 20>::integrate(
             [](double t) { return std::pow(std::expm1(-2 * t), 2); }, 0, log_of_ratio(b, a));
}

} // namespace rollwave
