#include "rollwave/exact/exact_solution.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/interrupt.h"
#include "rollwave/exact/bessel_modes.h"
#include "rollwave/exact/galerkin_pressure.h"

#include <deal.II/base/numbers.h>
#include <deal.II/lac/vector.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace rollwave {

using namespace dealii;

namespace {

/// Where the contact-free surface would meet the road: w is smaller than this angle.
double crossing_angle(const ExactScene& scene) {
  return scene.road.crossing_angle(scene.contact_free_displacement(scene.outer_radius));
}

/// The zero of the defect, which falls from positive to negative: looked for within @p margin of
/// @p guess, and further where it is not there.
double find_half_width(const GalerkinPressure& galerkin, double guess, double margin,
                       double crossing, MPI_Comm communicator) {
  const auto defect = [&](double w) {
    if (is_interrupted(communicator))
      throw Interrupted("interrupted before the exact solution was found");
    return galerkin.solve(w).defect;
  };
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

ExactSolution without_contact(const ExactScene& scene) {
  const double f = scene.force_density;
  const double work =
      2 * numbers::PI * f * f * contact_free_unit_work(scene.inner_radius, scene.outer_radius);
  ExactSolution solution = {scene};
  solution.energy = -work / 2;
  solution.norm_squared = work;
  return solution;
}

ExactSolution solution_at(const ExactScene& scene, const GalerkinPressure& galerkin, double w) {
  const GalerkinPressure::Trial trial = galerkin.solve(w);
  std::vector<double> coefficients(2 * galerkin.n);
  for (unsigned int i = 0; i < galerkin.n; ++i)
    coefficients[2 * i] = trial.coefficients(i);
  ExactSolution solution = without_contact(scene);
  solution.half_width = w;
  solution.end_exponent = galerkin.nu - 0.5;
  solution.pressure = {lowest_point, w, galerkin.nu, coefficients};

  const double a = scene.inner_radius, b = scene.outer_radius, f = scene.force_density;
  solution.loads.total = b * solution.pressure.fourier_integral(0).real();
  solution.loads.vertical = b * solution.pressure.fourier_integral(1).real();
  const Road& road = scene.road;
  const auto contact_work = [&](const std::function<double(double)>& function) {
    const Vector<double> moments = galerkin.moments(w, function);
    double sum = 0;
    for (unsigned int i = 0; i < galerkin.n; ++i)
      sum += b * w * trial.coefficients(i) * moments(i);
    return sum;
  };
  solution.loads.work_conjugate =
      contact_work([&](double x) { return road.distance_derivative(x); });
  const double pressure_times_road = contact_work([&](double x) { return road.displacement(x); });

  // (f, u) = a(u_f, u) = (f, u_f) - b int lambda u_f dz
  const double work_of_f_alone = 2 * numbers::PI * f * f * contact_free_unit_work(a, b);
  const double work_of_f =
      work_of_f_alone - scene.contact_free_displacement(b) * solution.loads.total;
  solution.norm_squared = work_of_f - pressure_times_road;
  solution.energy = solution.norm_squared / 2 - work_of_f;
  if (galerkin.nu < 0.5)
    solution.peak_pressure = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 400; ++i)
    solution.peak_pressure =
        std::max(solution.peak_pressure, solution.pressure(lowest_point + w * i / 400.));
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

/// The solution with @p end_exponent. Its numbers are the limits of those of three series, with 12,
/// 24 and 48 terms.
ExactSolution solve_with_ends(const ExactScene& scene, const BesselModes& modes,
                              double end_exponent, MPI_Comm communicator) {
  const double crossing = crossing_angle(scene);
  double guess = 0.75 * crossing, margin = 0.7 * crossing;
  std::vector<ExactSolution> sequence;
  for (const unsigned int n_terms : {12, 24, 48}) {
    const GalerkinPressure galerkin(scene, modes, end_exponent, n_terms);
    double w = scene.zone_half_width;
    if (end_exponent > 0) {
      w = find_half_width(galerkin, guess, margin, crossing, communicator);
      margin = sequence.empty() ? 0.02 * crossing : std::abs(w - guess) + 1e-8 * w;
      guess = w;
    }
    sequence.push_back(solution_at(scene, galerkin, w));
  }
  const auto limit = [&](auto number) {
    return Limit(number(sequence[0]), number(sequence[1]), number(sequence[2]));
  };
  ExactSolution solution = sequence.back();
  const Limit force = limit([](const ExactSolution& exact) { return exact.loads.total; });
  const Limit energy = limit(std::mem_fn(&ExactSolution::energy));
  const Limit half_width = limit(std::mem_fn(&ExactSolution::half_width));
  solution.loads = {
      force.value, limit([](const ExactSolution& exact) { return exact.loads.vertical; }).value,
      limit([](const ExactSolution& exact) { return *exact.loads.work_conjugate; }).value};
  solution.force_accuracy = force.relative_accuracy();
  solution.energy = energy.value;
  solution.energy_accuracy = energy.relative_accuracy();
  solution.half_width = half_width.value;
  solution.half_width_accuracy = half_width.relative_accuracy();
  solution.norm_squared = limit(std::mem_fn(&ExactSolution::norm_squared)).value;
  if (end_exponent > 0)
    solution.peak_pressure = limit(std::mem_fn(&ExactSolution::peak_pressure)).value;
  return solution;
}

} // namespace

ExactSolution solve_exactly(const ExactScene& scene, MPI_Comm communicator) {
  const double margin = std::max(0., 1 - scene.angular_velocity * scene.outer_radius);
  const double crossing = crossing_angle(scene);
  if (crossing == 0)
    return without_contact(scene);
  const BesselModes modes(scene.inner_radius, scene.outer_radius, scene.angular_velocity);
  // The law with s = 1/3 holds at distances above (2 e)^(3/2), the one with s = 1/2 below. The
  // longest series resolves distances down to some 1e-4 of the half-width.
  const double crossover = std::pow(2 * margin, 1.5);
  const bool is_critical = crossover < 1e-7 * crossing;
  const bool is_slow = crossover > 0.3 * crossing;
  // A zone narrower than the free contact shows in a defect of the sign of a w that is too small.
  // The tangent of a drum is not such a zone: the contact ends before it.
  if (scene.zone_half_width < (1 - 1e-9) * crossing &&
      GalerkinPressure(scene, modes, is_critical ? 2. / 3 : 0.5, 24)
              .solve(scene.zone_half_width)
              .defect > 0) {
    ExactSolution cut = solve_with_ends(scene, modes, is_critical ? -1. / 3 : -0.5, communicator);
    cut.ends_resolved = is_critical || is_slow;
    return cut;
  }
  if (is_critical)
    return solve_with_ends(scene, modes, 2. / 3, communicator);
  const ExactSolution slow = solve_with_ends(scene, modes, 0.5, communicator);
  if (is_slow)
    return slow;
  const ExactSolution critical = solve_with_ends(scene, modes, 2. / 3, communicator);
  ExactSolution better = slow.force_accuracy < critical.force_accuracy ? slow : critical;
  better.ends_resolved = false;
  return better;
}

} // namespace rollwave
