#include "rollwave/exact/gegenbauer_pressure.h"

#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/gamma.hpp>

#include <algorithm>
#include <cfenv>
#include <cmath>

namespace rollwave {

namespace {

/// Computes without stopping at floating-point exceptions while it lives, even where they trap.
class NonStop {
public:
  NonStop() { std::feholdexcept(&environment); }
  ~NonStop() { std::fesetenv(&environment); }
  NonStop(const NonStop&) = delete;
  NonStop& operator=(const NonStop&) = delete;

private:
  std::fenv_t environment;
};

/// J_order(x) in double precision throughout: long double would triple its cost. Boost computes Y
/// beside it, and where nobody asks for Y compares NaN, an invalid operation without effect.
double bessel_j(double order, double x) {
  using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
  const NonStop boost_compares_nan;
  return boost::math::cyl_bessel_j(order, x, Policy());
}

} // namespace

std::vector<double> gegenbauer_transforms(double nu, unsigned int count, double x) {
  std::vector<double> bessel(count);
  if (x == 0) {
    // x^-nu J_(n+nu)(x) vanishes at x = 0 but for n = 0.
    std::vector<double> transforms(count, 0.);
    transforms[0] = std::pow(2., -nu) / boost::math::tgamma(nu + 1);
    return transforms;
  }
  // The recurrence of Bessel functions is stable upwards below the order x, downwards above.
  const unsigned int last = count - 1;
  if (x >= last + nu) {
    bessel[0] = bessel_j(nu, x);
    if (count > 1)
      bessel[1] = bessel_j(nu + 1, x);
    for (unsigned int n = 1; n + 1 < count; ++n)
      bessel[n + 1] = 2 * (n + nu) / x * bessel[n] - bessel[n - 1];
  } else {
    // Miller's algorithm: from any start far above, normalised at a member that is not small.
    const int start = last + 20 + 2 * static_cast<int>(std::sqrt(40. * (last + 1)));
    double above = 0, here = 1e-280;
    unsigned int anchor = 0;
    for (int n = start; n >= 0; --n) {
      if (n <= static_cast<int>(last))
        bessel[n] = here;
      const double below = 2 * (n + nu) / x * here - above;
      above = here;
      here = below;
      if (std::abs(here) > 1e250) {
        above *= 1e-250;
        here *= 1e-250;
        for (unsigned int j = n; j <= last; ++j)
          bessel[j] *= 1e-250;
      }
    }
    for (unsigned int n = 1; n < std::min(count, 3u); ++n)
      if (std::abs(bessel[n]) > std::abs(bessel[anchor]))
        anchor = n;
    const double factor = bessel_j(anchor + nu, x) / bessel[anchor];
    for (double& value : bessel)
      value *= factor;
  }
  const double power = std::pow(x, -nu);
  for (double& value : bessel)
    value *= power;
  return bessel;
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

double GegenbauerPressure::cosine_integral(double k) const {
  const std::vector<double> transforms = gegenbauer_transforms(nu, a.size(), k * w);
  double sum = 0;
  for (unsigned int n = 0; n < a.size(); n += 2)
    sum += (n % 4 ? -1 : 1) * a[n] * transforms[n];
  return w * sum;
}

double GegenbauerPressure::sine_integral(double k) const {
  const std::vector<double> transforms = gegenbauer_transforms(nu, a.size(), k * w);
  double sum = 0;
  for (unsigned int n = 1; n < a.size(); n += 2)
    sum += (n % 4 == 3 ? -1 : 1) * a[n] * transforms[n];
  return w * sum;
}

} // namespace rollwave
