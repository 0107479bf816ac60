#include "rollwave/exact/gegenbauer_pressure.h"

#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/gamma.hpp>

#include <cmath>

namespace rollwave {

namespace {

/// J_order(x) in double precision throughout: long double would triple its cost.
double bessel_j(double order, double x) {
  using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
  return boost::math::cyl_bessel_j(order, x, Policy());
}

} // namespace

std::vector<double> gegenbauer_transforms(double nu, unsigned int count, double x) {
  std::vector<double> transforms(count);
  if (x == 0) {
    // x^-nu J_(n+nu)(x) vanishes at x = 0 except for n = 0.
    transforms[0] = std::pow(2., -nu) / boost::math::tgamma(nu + 1);
    return transforms;
  }
  const double power = std::pow(x, -nu);
  // The recurrence of Bessel functions is stable upwards below the order x.
  for (unsigned int n = 0; n < count; ++n)
    transforms[n] = n < 2 || n - 1 + nu > x
                        ? power * bessel_j(n + nu, x)
                        : 2 * (n - 1 + nu) / x * transforms[n - 1] - transforms[n - 2];
  return transforms;
}

std::vector<double> gegenbauer_polynomials(double nu, unsigned int count, double t) {
  std::vector<double> values(count);
  const double pi = boost::math::constants::pi<double>();
  if (nu == 0) {
    double previous = t, here = 1;
    for (double& value : values) {
      value = here / pi;
      const double next = 2 * t * here - previous;
      previous = here;
      here = next;
    }
    return values;
  }
  // (n + 1) C_(n+1) = 2 (n + nu) t C_n - (n + 2 nu - 1) C_(n-1), and h_(n+1)/h_n is rational.
  double h = boost::math::tgamma(nu) / (pi * std::pow(2., 1 - nu) * boost::math::tgamma(2 * nu));
  double previous = 0, here = 1;
  for (unsigned int n = 0; n < count; ++n) {
    values[n] = h * here;
    const double next = (2 * (n + nu) * t * here - (n + 2 * nu - 1) * previous) / (n + 1);
    previous = here;
    here = next;
    h *= (n + 1) / (n + 2 * nu);
  }
  return values;
}

GegenbauerPressure::GegenbauerPressure(double middle, double half_width, double nu,
                                       const std::vector<double>& coefficients)
    : m(middle), w(half_width), nu(nu), a(coefficients) {}

double GegenbauerPressure::over_weight(double z) const {
  const std::vector<double> polynomials = gegenbauer_polynomials(nu, a.size(), (z - m) / w);
  double sum = 0;
  for (unsigned int n = 0; n < a.size(); ++n)
    sum += a[n] * polynomials[n];
  return sum;
}

double GegenbauerPressure::operator()(double z) const {
  const double t = (z - m) / w;
  return std::abs(t) < 1 ? over_weight(z) * std::pow((1 - t) * (1 + t), nu - 0.5) : 0;
}

std::complex<double> GegenbauerPressure::fourier_integral(double k) const {
  const std::vector<double> transforms = gegenbauer_transforms(nu, a.size(), k * w);
  std::complex<double> sum = 0, power_of_i = 1;
  for (unsigned int n = 0; n < a.size(); ++n, power_of_i *= std::complex<double>(0, 1))
    sum += a[n] * transforms[n] * power_of_i;
  return w * sum;
}

} // namespace rollwave
