#include "rollwave/exact/galerkin_pressure.h"

#include "rollwave/base/errors.h"
#include "rollwave/exact/gegenbauer_pressure.h"

#include <deal.II/base/numbers.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

struct GaussRule {
  std::vector<double> points;
  std::vector<double> weights;
};

/// Gauss' rule for the weight (1 - t^2)^(nu - 1/2) on (-1, 1), from the eigenvalues of the matrix
/// of its orthogonal polynomials (G. H. Golub and J. H. Welsch, Math. Comp. 23 (1969) 221-230).
GaussRule gauss_gegenbauer(double nu, unsigned int n_points) {
  LAPACKFullMatrix<double> jacobi(n_points);
  for (unsigned int k = 1; k < n_points; ++k) {
    const double square =
        k == 1 ? 1 / (2 * (1 + nu)) : k * (k + 2 * nu - 1) / (4 * (k + nu) * (k + nu - 1));
    jacobi(k, k - 1) = jacobi(k - 1, k) = std::sqrt(square);
  }
  FullMatrix<double> vectors;
  Vector<double> eigenvalues;
  jacobi.compute_eigenvalues_symmetric(-2, 2, 0, eigenvalues, vectors);
  const double total = std::sqrt(numbers::PI) * std::tgamma(nu + 0.5) / std::tgamma(nu + 1);
  GaussRule rule;
  for (unsigned int i = 0; i < n_points; ++i) {
    rule.points.push_back(eigenvalues(i));
    rule.weights.push_back(total * vectors(0, i) * vectors(0, i));
  }
  return rule;
}

/// Panels of a ModeSum beyond which it would take too long.
constexpr double most_panels = 20000;

} // namespace

/// A rule for sums over all integers k of even functions: sum_k F(k) = sum_i weight_i F(k_i) +
/// tail.
struct GalerkinPressure::ModeSum {
  std::vector<double> k;
  std::vector<double> weight;
  std::vector<double> compliance; ///< c(k_i)
  double last;                    ///< the sum covers |k| < last

  /// @p largest_k is where the tail begins.
  ModeSum(const BesselModes& modes, double largest_k, double half_width) {
    // Where single terms would be too many, they are dense enough for an integral.
    const double single = largest_k > 40000 ? 3000 : std::ceil(largest_k);
    for (double j = 0; j <= single; ++j)
      add(j, j == 0 ? 1 : 2);
    last = single + 0.5;
    if (single < largest_k) {
      const double longest_panel = 8 / half_width;
      if (largest_k / longest_panel > most_panels)
        throw NotSolved(
            "the exact solution would need too many modes: the contact is long compared with "
            "the thickness of the ring");
      // By the formula of Euler and Maclaurin the sum, a midpoint rule, exceeds the integral by
      // F'/24 at the lower end. F' is taken as a difference quotient.
      weight.back() -= 2. / 24;
      add(single + 1, 2. / 24);
      const auto& points = boost::math::quadrature::gauss<double, 16>::abscissa();
      const auto& weights = boost::math::quadrature::gauss<double, 16>::weights();
      while (last < largest_k) {
        const double length = std::min(0.3 * last, longest_panel);
        for (unsigned int i = 0; i < points.size(); ++i)
          for (const double sign : {-1., 1.})
            add(last + length / 2 * (1 + sign * points[i]), length * weights[i]);
        last += length;
      }
    }
    compliance.reserve(k.size());
    for (const double mode : k)
      compliance.push_back(modes.compliance(mode));
  }

private:
  void add(double mode, double mode_weight) {
    k.push_back(mode);
    weight.push_back(mode_weight);
  }
};

GalerkinPressure::GalerkinPressure(const ExactScene& scene, const BesselModes& modes,
                                   double end_exponent, unsigned int n_terms)
    : nu(end_exponent + 0.5), n(n_terms), scene(scene), modes(modes),
      s(end_exponent < 0 ? -end_exponent : 1 - end_exponent) {
  GaussRule rule = gauss_gegenbauer(nu, 2 * n_terms + 30);
  points = std::move(rule.points);
  weights = std::move(rule.weights);
  polynomials.reinit(points.size(), n + 1);
  for (unsigned int q = 0; q < points.size(); ++q) {
    const std::vector<double> all = gegenbauer_polynomials(nu, 2 * n + 1, points[q]);
    for (unsigned int i = 0; i <= n; ++i)
      polynomials(q, i) = all[2 * i];
  }
}

GalerkinPressure::~GalerkinPressure() = default;

GalerkinPressure::Trial GalerkinPressure::solve(double w) const {
  const FullMatrix<double> matrix = interaction(w);
  const double free = scene.contact_free_displacement(scene.outer_radius);
  const Road& road = scene.road;
  const Vector<double> rhs = moments(w, [&](double x) { return free - road.displacement(x); });
  LAPACKFullMatrix<double> system(n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      system(i, j) = matrix(i, j);
  Trial trial = {Vector<double>(rhs.begin(), rhs.begin() + n), rhs(n)};
  system.set_property(LAPACKSupport::symmetric);
  system.compute_cholesky_factorization();
  system.solve(trial.coefficients);
  for (unsigned int j = 0; j < n; ++j)
    trial.defect -= matrix(n, j) * trial.coefficients(j);
  return trial;
}

Vector<double> GalerkinPressure::moments(double w,
                                         const std::function<double(double)>& function) const {
  Vector<double> result(n + 1);
  for (unsigned int q = 0; q < points.size(); ++q) {
    const double value = weights[q] * function(w * points[q]);
    for (unsigned int i = 0; i <= n; ++i)
      result(i) += value * polynomials(q, i);
  }
  return result;
}

/// A_ij = (w / 2 pi) sum_k c_k g_i(k w) g_j(k w), g_i the transform of the term 2 i.
FullMatrix<double> GalerkinPressure::interaction(double w) const {
  if (!sum || w < 0.7 * sum_width || w > 1.4 * sum_width) {
    // Bessel functions have their asymptotic form where the argument exceeds the square of the
    // order.
    const double largest_argument = std::max(6000., 2. * (2 * n) * (2 * n));
    sum =
        std::make_unique<ModeSum>(modes, std::max(largest_argument / w, modes.hub_free_mode()), w);
    sum_width = w;
  }
  const unsigned int n_modes = sum->k.size();
  FullMatrix<double> transforms(n_modes, n + 1), scaled(n_modes, n + 1), matrix(n + 1, n + 1);
  for (unsigned int m = 0; m < n_modes; ++m) {
    const std::vector<double> all = gegenbauer_transforms(nu, 2 * n + 1, sum->k[m] * w);
    for (unsigned int i = 0; i <= n; ++i) {
      transforms(m, i) = (i % 2 ? -1 : 1) * all[2 * i];
      scaled(m, i) = transforms(m, i) * sum->weight[m] * sum->compliance[m] * w / (2 * numbers::PI);
    }
  }
  transforms.Tmmult(matrix, scaled);

  // Beyond, c_k falls like k^(-2 s) and g_i g_j has the mean x^(-2 nu) / (pi x): the signs of the
  // transforms and of the Bessel functions' phases cancel.
  const double k = sum->last;
  const double power = 2 * s + 2 * nu;
  const double tail = 2 * w / (2 * numbers::PI) * modes.compliance_without_hub(k) * k *
                      std::pow(k * w, -2 * nu - 1) / (numbers::PI * power);
  for (unsigned int i = 0; i <= n; ++i)
    for (unsigned int j = 0; j <= n; ++j)
      matrix(i, j) += tail;
  return matrix;
}

} // namespace rollwave
