#include "force_panel.h"

#include "contact_free.h"
#include "errors.h"
#include "scene.h"
#include "straight_jump.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rollwave {

using namespace dealii;

namespace {

/// Gauss' points of a panel in one direction, and more on which f_0 is compared with f.
struct PanelPoints {
  PanelPoints()
      : gauss(n), fine(ForcePanel::n_points), to_coefficients(n, n), to_values(fine.size(), n) {
    for (unsigned int q = 0; q < n; ++q) {
      const auto values = legendre_values(gauss.point(q)[0]);
      for (unsigned int k = 0; k < n; ++k)
        to_coefficients(k, q) = gauss.weight(q) * values[k];
    }
    for (unsigned int p = 0; p < fine.size(); ++p) {
      const auto values = legendre_values(fine.point(p)[0]);
      std::copy(values.begin(), values.end(), &to_values(p, 0));
    }
  }

  static constexpr unsigned int n = ForcePiece::n_coefficients;
  const QGauss<1> gauss;
  const QGaussLobatto<1> fine;
  FullMatrix<double> to_coefficients, to_values;
};

const PanelPoints& points() {
  static const PanelPoints all;
  return all;
}

/// r f
double moment(const Scene& scene, double r, double z) {
  const double f = scene.force(r, z);
  if (!std::isfinite(f))
    throw BadInput(force_not_finite_at(scene, r, z));
  return r * f;
}

/// r f at a point given by shares of a panel's sides.
double moment(const Scene& scene, const ForcePanel& panel, const Point<2>& share) {
  return moment(scene, point_within(panel.low[0], panel.high[0], share[0]),
                point_within(panel.low[1], panel.high[1], share[1]));
}

/// Of what is given at the points of a product of a rule.
double mean_of(const FullMatrix<double>& values, const Quadrature<1>& rule) {
  double mean = 0;
  for (unsigned int q = 0; q < rule.size(); ++q)
    for (unsigned int p = 0; p < rule.size(); ++p)
      mean += rule.weight(q) * rule.weight(p) * values(q, p);
  return mean;
}

/// The mean squares of its parts without the mean: a function of z (rows), a function of r
/// (columns), and the rest.
ForcePanel::MeanSquares mean_squares(const FullMatrix<double>& values, const Quadrature<1>& rule,
                                     double mean) {
  std::vector<double> mean_z(rule.size()), mean_r(rule.size());
  for (unsigned int q = 0; q < rule.size(); ++q)
    for (unsigned int p = 0; p < rule.size(); ++p) {
      mean_z[q] += rule.weight(p) * (values(q, p) - mean);
      mean_r[p] += rule.weight(q) * (values(q, p) - mean);
    }
  ForcePanel::MeanSquares squares;
  for (unsigned int q = 0; q < rule.size(); ++q) {
    squares.of_z += rule.weight(q) * mean_z[q] * mean_z[q];
    squares.of_r += rule.weight(q) * mean_r[q] * mean_r[q];
    for (unsigned int p = 0; p < rule.size(); ++p)
      squares.rest += rule.weight(q) * rule.weight(p) *
                      std::pow(values(q, p) - mean - mean_z[q] - mean_r[p], 2);
  }
  return squares;
}

} // namespace

double friedrichs_squared(const Scene& scene) {
  return contact_free_unit_displacement(scene.inner_radius, scene.outer_radius, scene.outer_radius);
}

ForcePanel::ForcePanel(const Scene& scene, const Point<2>& low, const Point<2>& high)
    : low(low), high(high) {
  interpolate(scene);
}

void ForcePanel::interpolate(const Scene& scene) {
  FullMatrix<double> nodal(n), half(n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < n; ++i)
      nodal(j, i) = moment(scene, *this, {points().gauss.point(i)[0], points().gauss.point(j)[0]});
  points().to_coefficients.mmult(half, nodal);
  coefficients.reinit(n, n);
  half.mTmult(coefficients, points().to_coefficients);

  double largest[n] = {}; // of each row
  for (unsigned int l = 0; l < n; ++l)
    for (unsigned int k = 0; k < n; ++k)
      largest[l] = std::max(largest[l], std::abs(coefficients(l, k)));
  const double negligible = 1e-15 * *std::max_element(largest, largest + n);
  n_rows = n;
  while (n_rows > 1 && largest[n_rows - 1] <= negligible)
    --n_rows;
}

void ForcePanel::judge(const Scene& scene) {
  const QGaussLobatto<1>& rule = points().fine;
  FullMatrix<double> rows(rule.size(), n), missing(rule.size()), all(rule.size());
  points().to_values.mmult(rows, coefficients);
  rows.mTmult(missing, points().to_values);
  for (unsigned int q = 0; q < rule.size(); ++q)
    for (unsigned int p = 0; p < rule.size(); ++p) {
      all(q, p) = moment(scene, *this, {rule.point(p)[0], rule.point(q)[0]});
      missing(q, p) = all(q, p) - missing(q, p);
      norm_squared += area() * rule.weight(p) * rule.weight(q) * all(q, p) * all(q, p) /
                      (low[0] + rule.point(p)[0] * (high[0] - low[0]));
    }
  const double mean = mean_of(missing, rule);
  squares = mean_squares(missing, rule, mean);
  coefficients(0, 0) += mean;
  squares_beside_mean = mean_squares(all, rule, mean_of(all, rule));
  weigh(scene,
        std::max(std::abs(mean), std::sqrt(squares.of_r + squares.of_z + squares.rest / 16) / 4));
}

void ForcePanel::weigh(const Scene& scene, double mean) {
  missed = weigh(scene, squares, mean);
  beside_mean = weigh(scene, squares_beside_mean, std::sqrt(squares_beside_mean.sum()));
}

void ForcePanel::look_along(const Scene& scene, unsigned int direction,
                            const std::vector<double>& coordinates) {
  Point<2> point = low + (high - low) / 2;
  const Tensor<1, 2> size = high - low;
  std::vector<double> missing;
  for (const double x : coordinates) {
    point[direction] = x;
    const auto along_r = legendre_values((point[0] - low[0]) / size[0]),
               along_z = legendre_values((point[1] - low[1]) / size[1]);
    double value = moment(scene, point[0], point[1]);
    for (unsigned int l = 0; l < n_rows; ++l)
      for (unsigned int k = 0; k < n; ++k)
        value -= coefficients(l, k) * along_z[l] * along_r[k];
    missing.push_back(value);
  }
  const double mean = std::accumulate(missing.begin(), missing.end(), 0.) / missing.size();
  double variance = 0;
  for (const double value : missing)
    variance += (value - mean) * (value - mean) / missing.size();
  const auto along = [direction](MeanSquares& all) -> double& {
    return direction == 0 ? all.of_r : all.of_z;
  };
  if (variance <= 4 * (along(squares) + squares.rest))
    return;
  for (MeanSquares* all : {&squares, &squares_beside_mean})
    along(*all) = std::max(along(*all), variance);
  weigh(scene, std::max(missed.mean, std::sqrt(variance)));
}

unsigned int ForcePanel::rougher_direction() const {
  constexpr double round_off = 1e-13;
  double tail[] = {squares.of_r, squares.of_z}, all = 0;
  for (unsigned int l = 0; l < n; ++l)
    for (unsigned int k = 0; k < n; ++k) {
      const double square = coefficients(l, k) * coefficients(l, k);
      all += square;
      if (k + 2 >= n)
        tail[0] += square;
      if (l + 2 >= n)
        tail[1] += square;
    }
  if (std::max(tail[0], tail[1]) <= round_off * round_off * all)
    return high[0] * (high[1] - low[1]) > high[0] - low[0] ? 1 : 0;
  return tail[0] > tail[1] ? 0 : 1;
}

ForcePanel::Missed ForcePanel::weigh(const Scene& scene, const MeanSquares& squares,
                                     double mean) const {
  const Tensor<1, 2> size = high - low;
  // Factors of the squares; the speed may be a rounding beyond the critical one.
  const double by_r = std::pow(size[0] / numbers::PI, 2) / low[0];
  const double by_norm = friedrichs_squared(scene) / low[0];
  const double angular_stiffness = high[0] * std::max(0., scene.alpha(high[0]));
  double by_z = std::pow(size[1] / numbers::PI, 2);
  const bool is_local = by_z < by_norm * angular_stiffness;
  by_z = is_local ? by_z / angular_stiffness : by_norm;
  const double of_z = area() * by_z * squares.of_z;
  const double local =
      by_r * squares.of_r + (is_local ? std::min(by_r, by_z) : by_r) * squares.rest;
  return {mean, area() * local + (is_local ? of_z : 0), is_local ? 0 : of_z};
}

ForcePanel::Missed ForcePanel::weigh(const Scene& scene, const MeanSquares& squares, double mean,
                                     double more) const {
  MeanSquares more_along_r = squares, more_along_z = squares;
  more_along_r.of_r += more;
  more_along_z.of_z += more;
  const Missed along_r = weigh(scene, more_along_r, mean),
               along_z = weigh(scene, more_along_z, mean);
  return along_r.varying_squared() > along_z.varying_squared() ? along_r : along_z;
}

void ForcePanel::take_for(const Scene& scene, double mean, double mean_square) {
  const double more = std::max(0., mean_square - squares.sum());
  missed = weigh(scene, squares, std::max(missed.mean, std::abs(mean)), more);
  beside_mean = weigh(scene, squares_beside_mean, std::max(beside_mean.mean, std::abs(mean)), more);
}

double ForcePanel::squared_alone(const Scene& scene, const Missed& left_out) const {
  const double by_integral = (high[0] - low[0]) * log_of_ratio(high[0], scene.inner_radius);
  return left_out.varying_squared() + area() * by_integral * left_out.mean * left_out.mean;
}

void ForcePanel::flatten() {
  const double mean = coefficients(0, 0);
  coefficients = 0;
  coefficients(0, 0) = mean;
  n_rows = 1;
  squares = squares_beside_mean;
  missed = beside_mean;
}

} // namespace rollwave
