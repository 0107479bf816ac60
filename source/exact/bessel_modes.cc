#include "rollwave/exact/bessel_modes.h"

#include "rollwave/scene/uniform_force.h"

#include <deal.II/base/quadrature_lib.h>

#include <boost/math/special_functions/legendre.hpp>
#include <boost/math/tools/fraction.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace rollwave {

namespace {

constexpr int n_gauss = 48;

/// The hub has no effect on the surface beyond this exponent: exp(-2 * 21) < 1e-18.
constexpr double negligible_exponent = 21;

/// The points lie in an interval of this length at most below the surface, in y = ln r. On a longer
/// one they would be too far apart near the surface, where theta changes. Below the interval omega
/// r is under 5e-5, and the modes are those of omega = 0.
constexpr double longest_interval = 10;

/// Panels of interpolation over k.
constexpr double first_panel = 64;
constexpr int n_panels = 16;

/// The numerators -x^2 and denominators 2 (k + n), n = 1, 2, ..., of a continued fraction.
struct BesselFraction {
  using result_type = std::pair<double, double>;
  double k, x;
  int n = 0;

  result_type operator()() { return {-x * x, 2 * (k + ++n)}; }
};

/// x J_k'(x) / J_k(x) for 0 <= x <= k, by the continued fraction of J_(k+1)/J_k,
/// k - x^2 / (2 (k + 1) - x^2 / (2 (k + 2) - ...)).
double logarithmic_derivative(double k, double x) {
  BesselFraction terms = {k, x};
  std::uintmax_t most_terms = 100000;
  return k - x * x /
                 boost::math::tools::continued_fraction_b(
                     terms, std::numeric_limits<double>::epsilon(), most_terms);
}

/// Values at Gauss-Legendre points.
using AtPoints = std::vector<double>;

double sum_of_products(const AtPoints& one, const AtPoints& other) {
  return std::inner_product(one.begin(), one.end(), other.begin(), 0.);
}

/// Gauss-Legendre points on [-1, 1] and the matrix of integrals from each point to 1.
struct SpectralIntegration {
  AtPoints point, weight;
  std::vector<AtPoints> to_the_right;

  SpectralIntegration() {
    const dealii::QGauss<1> gauss(n_gauss);
    for (int i = 0; i < n_gauss; ++i) {
      point.push_back(2 * gauss.point(i)[0] - 1);
      weight.push_back(2 * gauss.weight(i));
    }
    // The Lagrange polynomial of point j is weight_j sum_m (m + 1/2) P_m(x_j) P_m, and
    // (2 m + 1) int_x^1 P_m = P_(m-1)(x) - P_(m+1)(x), with P_(-1) = 1.
    std::vector<AtPoints> legendre(n_gauss + 2, AtPoints(n_gauss, 1)); // number m + 1 is P_m
    for (int i = 0; i < n_gauss; ++i) {
      legendre[2][i] = point[i];
      for (int m = 1; m < n_gauss; ++m)
        legendre[m + 2][i] =
            boost::math::legendre_next(m, point[i], legendre[m + 1][i], legendre[m][i]);
    }
    to_the_right.assign(n_gauss, AtPoints(n_gauss));
    for (int i = 0; i < n_gauss; ++i)
      for (int j = 0; j < n_gauss; ++j) {
        double sum = 0;
        for (int m = 0; m < n_gauss; ++m)
          sum += legendre[m + 1][j] * (legendre[m][i] - legendre[m + 2][i]);
        to_the_right[i][j] = weight[j] * sum / 2;
      }
  }

  /// The weights by which values at the points give the polynomial through them at t: barycentric
  /// interpolation.
  AtPoints interpolation(double t) const {
    AtPoints weights(n_gauss);
    const auto hit = std::find(point.begin(), point.end(), t);
    if (hit != point.end()) {
      weights[hit - point.begin()] = 1;
      return weights;
    }
    double sum = 0;
    for (int i = 0; i < n_gauss; ++i) {
      weights[i] =
          (i % 2 ? -1 : 1) * std::sqrt((1 - point[i] * point[i]) * weight[i]) / (t - point[i]);
      sum += weights[i];
    }
    for (double& of_point : weights)
      of_point /= sum;
    return weights;
  }
};

const SpectralIntegration& spectral_integration() {
  static const SpectralIntegration rule;
  return rule;
}

} // namespace

BesselMode::BesselMode(double inner_radius, double outer_radius, double angular_velocity, double k)
    : a(inner_radius), b(outer_radius), omega(std::min(angular_velocity, 1 / outer_radius)), k(k),
      theta_at_surface(logarithmic_derivative(k, k * omega * b)), q(0) {
  const SpectralIntegration& rule = spectral_integration();
  const double depth = interval(), below = log_of_ratio(b, a) - depth;
  AtPoints theta;
  for (const double point : rule.point)
    theta.push_back(logarithmic_derivative(k, k * omega * b * std::exp((point - 1) * depth / 2)));
  for (const AtPoints& weights : rule.to_the_right)
    exponent.push_back(sum_of_products(weights, theta) * depth / 2);
  const double at_begin = sum_of_products(rule.weight, theta) * depth / 2;
  if (at_begin + k * below >= negligible_exponent) { // from hub to b
    q = std::numeric_limits<double>::infinity();
    return;
  }
  AtPoints integrand;
  for (const double at_point : exponent)
    integrand.push_back(depth / 2 * std::exp(2 * at_point));
  q = sum_of_products(rule.weight, integrand);
  if (k * below > 0)
    q += std::exp(2 * at_begin) * std::expm1(2 * k * below) / (2 * k); // g ~ r^k below
  for (const AtPoints& weights : rule.to_the_right)
    q_to_the_right.push_back(sum_of_products(weights, integrand));
}

double BesselMode::compliance() const {
  return k == 0 ? b * log_of_ratio(b, a) : b / (theta_at_surface + 1 / q);
}

double BesselMode::interval() const {
  return std::min(log_of_ratio(b, a), longest_interval);
}

BesselMode::ValueAndSlope BesselMode::at(double r) const {
  const double depth = interval(), begin = b * std::exp(-depth), to_hub = log_of_ratio(r, a);
  if (k == 0)
    return {to_hub / log_of_ratio(b, a), 1 / (r * log_of_ratio(b, a))};
  if (depth == longest_interval && r < begin) { // R ~ (r/a)^k - (a/r)^k
    const double R =
        at(begin).value * std::pow(r / begin, k) / -std::expm1(-2 * k * log_of_ratio(begin, a));
    return {R * -std::expm1(-2 * k * to_hub), R * k * (1 + std::exp(-2 * k * to_hub)) / r};
  }
  const AtPoints weights =
      spectral_integration().interpolation(1 + 2 * std::log1p((r - b) / b) / depth);
  const double g = std::exp(-sum_of_products(weights, exponent));
  const double share =
      q_to_the_right.empty() ? 1 : 1 - sum_of_products(weights, q_to_the_right) / q;
  // d/dy (g q(y) / q) = theta g q(y) / q + 1 / (g q)
  return {g * share, (logarithmic_derivative(k, k * omega * r) * g * share + 1 / (g * q)) / r};
}

BesselModes::BesselModes(double inner_radius, double outer_radius, double angular_velocity)
    : a(inner_radius), b(outer_radius), omega(std::min(angular_velocity, 1 / outer_radius)) {
  hub_fades_at = 1;
  while (hub_matters(hub_fades_at))
    hub_fades_at *= 2;
  for (int panel = 0; panel < n_panels || std::ldexp(first_panel, panel) < hub_fades_at; ++panel) {
    const double begin = std::ldexp(first_panel, panel);
    panels.emplace_back();
    for (const double point : spectral_integration().point) {
      const double k = begin * (1 + (1 + point) / 2);
      panels.back().push_back(k * computed_compliance(k));
    }
  }
}

double BesselModes::compliance_without_hub(double k) const {
  return b / logarithmic_derivative(k, k * omega * b);
}

bool BesselModes::hub_matters(double k) const {
  // theta falls from the hub to the surface: the inner half alone bounds the exponent from below.
  const double at_middle = logarithmic_derivative(k, k * omega * std::sqrt(a * b));
  return at_middle * log_of_ratio(b, a) / 2 <= negligible_exponent;
}

double BesselModes::computed_compliance(double k) const {
  return k > 0 && !hub_matters(k) ? compliance_without_hub(k)
                                  : BesselMode(a, b, omega, k).compliance();
}

double BesselModes::compliance(double k) const {
  if (k <= first_panel)
    return computed_compliance(k);
  const int panel = std::min<int>(std::ilogb(k / first_panel), panels.size() - 1);
  const double begin = std::ldexp(first_panel, panel);
  const double t = 2 * (k - begin) / begin - 1;
  if (t > 1)
    return compliance_without_hub(k);
  return sum_of_products(spectral_integration().interpolation(t), panels[panel]) / k;
}

std::vector<double> BesselModes::profile(double k, const std::vector<double>& radii) const {
  const BesselMode mode(a, b, omega, k);
  std::vector<double> profile;
  for (const double r : radii)
    profile.push_back(mode.at(r).value);
  return profile;
}

} // namespace rollwave
