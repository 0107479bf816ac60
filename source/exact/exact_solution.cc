#include "rollwave/exact/exact_solution.h"

#include "rollwave/base/errors.h"
#include "rollwave/exact/bessel_modes.h"
#include "rollwave/exact/uniform_force.h"

#include <deal.II/base/numbers.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>

namespace rollwave {

using namespace dealii;

double contact_free_displacement(const ExactScene& scene, double r) {
  return scene.force_density *
         contact_free_unit_displacement(scene.inner_radius, scene.outer_radius, r);
}

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

/// phi at the angle x from the lowest point, as flat_road().
double road(const ExactScene& scene, double x) {
  const double sine = std::sin(x / 2);
  return (scene.road_distance - scene.outer_radius) +
         2 * scene.road_distance * sine * sine / std::cos(x);
}

/// Panels of a ModeSum beyond which it would take too long.
constexpr double most_panels = 20000;

/// A rule for sums over all integers k of even functions: sum_k F(k) = sum_i weight_i F(k_i) +
/// tail.
struct ModeSum {
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
        throw NotSolved("the exact solution would need too many modes: the contact is long beside "
                        "the thickness of the ring");
      // Euler and Maclaurin: the midpoint rule exceeds the integral by -F'/24 at its begin.
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

/// The series for one half-width: its coefficients, and by how much the next test fails.
struct Trial {
  Vector<double> coefficients;
  double defect;
};

class Collocation {
public:
  Collocation(const ExactScene& scene, const BesselModes& modes, double end_exponent,
              unsigned int n_terms)
      : scene(scene), modes(modes), nu(end_exponent + 0.5),
        s(end_exponent < 0 ? -end_exponent : 1 - end_exponent), n(n_terms),
        rule(gauss_gegenbauer(nu, 2 * n_terms + 30)), polynomials(rule.points.size(), n_terms + 1) {
    for (unsigned int q = 0; q < rule.points.size(); ++q) {
      const std::vector<double> all = gegenbauer_polynomials(nu, 2 * n + 1, rule.points[q]);
      for (unsigned int i = 0; i <= n; ++i)
        polynomials(q, i) = all[2 * i];
    }
  }

  Trial solve(double w) const {
    const FullMatrix<double> matrix = interaction(w);
    const Vector<double> rhs = indentation(w);
    LAPACKFullMatrix<double> system(n);
    Trial trial;
    trial.coefficients.reinit(n);
    for (unsigned int i = 0; i < n; ++i) {
      for (unsigned int j = 0; j < n; ++j)
        system(i, j) = matrix(i, j);
      trial.coefficients(i) = rhs(i);
    }
    system.set_property(LAPACKSupport::symmetric);
    system.compute_cholesky_factorization();
    system.solve(trial.coefficients);
    trial.defect = rhs(n);
    for (unsigned int j = 0; j < n; ++j)
      trial.defect -= matrix(n, j) * trial.coefficients(j);
    return trial;
  }

  /// int h_i (1 - t^2)^(nu - 1/2) C_i(t) F(w t) dt for the even i.
  Vector<double> moments(double w, const std::function<double(double)>& function) const {
    Vector<double> result(n + 1);
    for (unsigned int q = 0; q < rule.points.size(); ++q) {
      const double value = rule.weights[q] * function(w * rule.points[q]);
      for (unsigned int i = 0; i <= n; ++i)
        result(i) += value * polynomials(q, i);
    }
    return result;
  }

  const ExactScene& scene;
  const BesselModes& modes;
  const double nu;
  const double s;
  const unsigned int n;

private:
  /// A_ij = (w / 2 pi) sum_k c_k g_i(k w) g_j(k w), g_i the transform of the term 2 i.
  FullMatrix<double> interaction(double w) const {
    if (!sum || w < 0.7 * sum_width || w > 1.4 * sum_width) {
      sum = std::make_unique<ModeSum>(modes,
                                      std::max(largest_argument() / w, modes.hub_free_mode()), w);
      sum_width = w;
    }
    const unsigned int n_modes = sum->k.size();
    FullMatrix<double> transforms(n_modes, n + 1), scaled(n_modes, n + 1), matrix(n + 1, n + 1);
    for (unsigned int m = 0; m < n_modes; ++m) {
      const std::vector<double> all = gegenbauer_transforms(nu, 2 * n + 1, sum->k[m] * w);
      for (unsigned int i = 0; i <= n; ++i) {
        transforms(m, i) = (i % 2 ? -1 : 1) * all[2 * i];
        scaled(m, i) =
            transforms(m, i) * sum->weight[m] * sum->compliance[m] * w / (2 * numbers::PI);
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

  Vector<double> indentation(double w) const {
    const double free = contact_free_displacement(scene, scene.outer_radius);
    return moments(w, [&](double x) { return free - road(scene, x); });
  }

  /// The transforms are summed up to here. Bessel functions have their asymptotic form where the
  /// argument exceeds the square of the order.
  double largest_argument() const { return std::max(6000., 2. * (2 * n) * (2 * n)); }

  GaussRule rule;
  FullMatrix<double> polynomials; ///< h_i C_i at the points of the rule, for the even i
  mutable std::unique_ptr<ModeSum> sum;
  mutable double sum_width = 0;
};

/// Where the contact-free surface would meet the road: w is smaller than this angle.
double crossing_angle(const ExactScene& scene) {
  return rollwave::crossing_angle(scene.outer_radius, scene.road_distance,
                                  contact_free_displacement(scene, scene.outer_radius));
}

/// The zero of the defect, which falls from positive to negative: looked for within @p margin of
/// @p guess, and further where it is not there.
double find_half_width(const Collocation& collocation, double guess, double margin,
                       double crossing) {
  const auto defect = [&](double w) { return collocation.solve(w).defect; };
  for (;; margin *= 10) {
    const double low = std::max(guess - margin, 0.02 * crossing);
    const double high = std::min(guess + margin, crossing);
    const double at_low = defect(low), at_high = defect(high);
    if (at_low > 0 && at_high < 0) {
      std::uintmax_t most_evaluations = 60;
      const auto [left, right] = boost::math::tools::toms748_solve(
          defect, low, high, at_low, at_high, [](double l, double r) { return r - l <= 4e-15 * r; },
          most_evaluations);
      return (left + right) / 2;
    }
    if (margin > crossing)
      throw NotSolved("the exact solution finds no contact that ends within " +
                      std::to_string(crossing) + " rad of the lowest point");
  }
}

ExactSolution describe(const ExactScene& scene, const Collocation& collocation, double w) {
  const Trial trial = collocation.solve(w);
  std::vector<double> coefficients(2 * collocation.n);
  for (unsigned int i = 0; i < collocation.n; ++i)
    coefficients[2 * i] = trial.coefficients(i);
  ExactSolution solution{scene, w,
                         0,     0,
                         0,     0,
                         0,     0,
                         0,     collocation.nu - 0.5,
                         true,  {3 * numbers::PI / 2, w, collocation.nu, coefficients}};

  const double a = scene.inner_radius, b = scene.outer_radius, f = scene.force_density;
  solution.force = b * solution.pressure.cosine_integral(0);
  const Vector<double> road_moments =
      collocation.moments(w, [&](double x) { return road(scene, x); });
  double pressure_times_road = 0;
  for (unsigned int i = 0; i < collocation.n; ++i)
    pressure_times_road += b * w * trial.coefficients(i) * road_moments(i);

  // (f, u) = a(u_f, u) = (f, u_f) - b int lambda u_f dz
  const double work_of_f_alone = 2 * numbers::PI * f * f * contact_free_unit_work(a, b);
  const double work_of_f = work_of_f_alone - contact_free_displacement(scene, b) * solution.force;
  solution.norm_squared = work_of_f - pressure_times_road;
  solution.energy = solution.norm_squared / 2 - work_of_f;
  if (collocation.nu < 0.5)
    solution.peak_pressure = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 400; ++i)
    solution.peak_pressure =
        std::max(solution.peak_pressure, solution.pressure(3 * numbers::PI / 2 + w * i / 400.));
  return solution;
}

/// Aitken's limit of a sequence that converges geometrically, and its distance from the last
/// member.
struct Limit {
  double value;
  double correction;

  Limit(double first, double second, double third) : value(third), correction(third - second) {
    const double early = second - first, late = third - second;
    // At round-off there is nothing to gain.
    if (std::abs(late) < 0.5 * std::abs(early)) {
      correction = late * late / (early - late);
      value += correction;
    }
  }

  /// Sums over modes are not better than 3e-11.
  double relative_accuracy() const { return std::max(std::abs(correction / value), 3e-11); }
};

/// The series with @p end_exponent, grown three times by doubling, and the limit of its numbers.
ExactSolution solve_with_ends(const ExactScene& scene, const BesselModes& modes,
                              double end_exponent) {
  const double crossing = crossing_angle(scene);
  double guess = 0.75 * crossing, margin = 0.7 * crossing;
  std::vector<ExactSolution> sequence;
  for (const unsigned int n_terms : {12, 24, 48}) {
    const Collocation collocation(scene, modes, end_exponent, n_terms);
    double w = scene.zone_half_width;
    if (end_exponent > 0) {
      w = find_half_width(collocation, guess, margin, crossing);
      margin = sequence.empty() ? 0.02 * crossing : std::abs(w - guess) + 1e-8 * w;
      guess = w;
    }
    sequence.push_back(describe(scene, collocation, w));
  }
  const auto limit = [&](auto member) {
    return Limit(sequence[0].*member, sequence[1].*member, sequence[2].*member);
  };
  ExactSolution solution = sequence.back();
  const Limit force = limit(&ExactSolution::force);
  const Limit energy = limit(&ExactSolution::energy);
  const Limit half_width = limit(&ExactSolution::half_width);
  solution.force = force.value;
  solution.force_accuracy = force.relative_accuracy();
  solution.energy = energy.value;
  solution.energy_accuracy = energy.relative_accuracy();
  solution.half_width = half_width.value;
  solution.half_width_accuracy = half_width.relative_accuracy();
  solution.norm_squared = limit(&ExactSolution::norm_squared).value;
  if (end_exponent > 0)
    solution.peak_pressure = limit(&ExactSolution::peak_pressure).value;
  return solution;
}

} // namespace

ExactSolution solve_exactly(const ExactScene& scene) {
  const double margin = std::max(0., 1 - scene.angular_velocity * scene.outer_radius);
  const double crossing = crossing_angle(scene);
  if (crossing == 0) {
    const double f = scene.force_density;
    const double work =
        2 * numbers::PI * f * f * contact_free_unit_work(scene.inner_radius, scene.outer_radius);
    return {scene, 0, 0, -work / 2, work, 0, 0, 0, 0, 0.5, true, {3 * numbers::PI / 2, 1, 1, {0.}}};
  }
  const BesselModes modes(scene.inner_radius, scene.outer_radius, scene.angular_velocity);
  // The law with s = 1/3 holds at distances above (2 e)^(3/2), the one with s = 1/2 below. The
  // longest series sees distances down to some 1e-4 of the half-width.
  const double crossover = std::pow(2 * margin, 1.5);
  const bool is_critical = crossover < 1e-7 * crossing;
  const bool is_slow = crossover > 0.3 * crossing;
  // A zone narrower than the free contact shows in a defect of the sign of a w that is too small.
  if (scene.zone_half_width < crossing && Collocation(scene, modes, is_critical ? 2. / 3 : 0.5, 24)
                                                  .solve(scene.zone_half_width)
                                                  .defect > 0) {
    ExactSolution cut = solve_with_ends(scene, modes, is_critical ? -1. / 3 : -0.5);
    cut.ends_resolved = is_critical || is_slow;
    return cut;
  }
  if (is_critical)
    return solve_with_ends(scene, modes, 2. / 3);
  const ExactSolution slow = solve_with_ends(scene, modes, 0.5);
  if (is_slow)
    return slow;
  const ExactSolution critical = solve_with_ends(scene, modes, 2. / 3);
  ExactSolution better = slow.force_accuracy < critical.force_accuracy ? slow : critical;
  better.ends_resolved = false;
  return better;
}

} // namespace rollwave
