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
    const auto legendre = [](int m, double x) {
      return m < 0 ? 1. : boost::math::legendre_p(m, x);
    };
    to_the_right.assign(n_gauss, AtPoints(n_gauss));
    for (int i = 0; i < n_gauss; ++i)
      for (int j = 0; j < n_gauss; ++j) {
        double sum = 0;
        for (int m = 0; m < n_gauss; ++m)
          sum += legendre(m, point[j]) * (legendre(m - 1, point[i]) - legendre(m + 1, point[i]));
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

/// theta and its integral at the points, and the integral of 1/g^2.
struct BesselModes::Samples {
  AtPoints exponent; ///< int_y^(ln b) theta
  double theta_at_surface;
  double largest_exponent; ///< from the hub to the surface
  double q; ///< int_(ln a)^(ln b) dy / g^2; infinite where the hub is too far inside to be felt
};

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

BesselModes::Samples BesselModes::sample(double k) const {
  const SpectralIntegration& rule = spectral_integration();
  const double depth = log_of_ratio(b, a);
  AtPoints theta;
  for (const double point : rule.point)
    theta.push_back(logarithmic_derivative(k, k * omega * b * std::exp((point - 1) * depth / 2)));

  Samples samples;
  samples.theta_at_surface = logarithmic_derivative(k, k * omega * b);
  for (const AtPoints& weights : rule.to_the_right)
    samples.exponent.push_back(sum_of_products(weights, theta) * depth / 2);
  samples.largest_exponent = sum_of_products(rule.weight, theta) * depth / 2;
  samples.q = 0;
  if (samples.largest_exponent >= negligible_exponent) {
    samples.q = std::numeric_limits<double>::infinity();
    return samples;
  }
  for (int i = 0; i < n_gauss; ++i)
    samples.q += rule.weight[i] * depth / 2 * std::exp(2 * samples.exponent[i]);
  return samples;
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
  if (k == 0)
    return b * log_of_ratio(b, a);
  if (!hub_matters(k))
    return compliance_without_hub(k);
  const Samples samples = sample(k);
  return b / (samples.theta_at_surface + 1 / samples.q);
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
  const double depth = log_of_ratio(b, a);
  std::vector<double> profile;
  if (k == 0) {
    for (const double r : radii)
      profile.push_back(log_of_ratio(r, a) / depth);
    return profile;
  }

  const SpectralIntegration& rule = spectral_integration();
  const Samples samples = sample(k);
  const bool has_hub = std::isfinite(samples.q);
  // int_y^(ln b) dy / g^2 at the points
  AtPoints integrand, q_to_the_right(n_gauss);
  for (int i = 0; i < n_gauss && has_hub; ++i)
    integrand.push_back(depth / 2 * std::exp(2 * samples.exponent[i]));
  for (int i = 0; i < n_gauss && has_hub; ++i)
    q_to_the_right[i] = sum_of_products(rule.to_the_right[i], integrand);
  for (const double r : radii) {
    const AtPoints weights = rule.interpolation(1 + 2 * std::log1p((r - b) / b) / depth);
    const double share = has_hub ? 1 - sum_of_products(weights, q_to_the_right) / samples.q : 1;
    const double g = std::exp(-sum_of_products(weights, samples.exponent));
    profile.push_back(g * share);
  }
  return profile;
}

} // namespace rollwave
