#include "force_interpolant.h"

#include "contact_free.h"
#include "errors.h"
#include "scene.h"

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

constexpr unsigned int n = ForcePiece::n_coefficients;
constexpr double tolerance = 1e-13; ///< of f_0
constexpr double smallest = 4e-15;  ///< panel, over its distance from the origin

const std::vector<Polynomials::Polynomial<double>>& legendre() {
  static const auto polynomials = Polynomials::Legendre::generate_complete_basis(n - 1);
  return polynomials;
}

/// Gauss' points of a panel in one direction, and more on which f_0 is compared with f.
struct PanelPoints {
  PanelPoints() : gauss(n), fine(3 * n / 2), to_coefficients(n, n), to_values(fine.size(), n) {
    for (unsigned int k = 0; k < n; ++k) {
      for (unsigned int q = 0; q < n; ++q)
        to_coefficients(k, q) = gauss.weight(q) * legendre()[k].value(gauss.point(q)[0]);
      for (unsigned int p = 0; p < fine.size(); ++p)
        to_values(p, k) = legendre()[k].value(fine.point(p)[0]);
    }
  }

  QGauss<1> gauss, fine;
  FullMatrix<double> to_coefficients, to_values;
};

/// The direction in which a panel is longer.
unsigned int longer_direction(const Point<2>& low, const Point<2>& high) {
  return high[0] * (high[1] - low[1]) > high[0] - low[0] ? 1 : 0;
}

/// The direction in which the last two coefficients are larger.
unsigned int rougher_direction(const FullMatrix<double>& coefficients) {
  double tail[] = {0, 0};
  for (unsigned int l = 0; l < n; ++l)
    for (unsigned int k = 0; k < n; ++k) {
      const double square = coefficients(l, k) * coefficients(l, k);
      if (k + 2 >= n)
        tail[0] += square;
      if (l + 2 >= n)
        tail[1] += square;
    }
  return tail[0] > tail[1] ? 0 : 1;
}

/// The mean of what is given at the points of a product of a rule, and the mean squares of its
/// parts without it: a function of z (rows), a function of r (columns), and the rest.
struct MeanSquares {
  MeanSquares(const FullMatrix<double>& values, const Quadrature<1>& rule) {
    std::vector<double> mean_z(rule.size()), mean_r(rule.size());
    double square = 0;
    for (unsigned int q = 0; q < rule.size(); ++q)
      for (unsigned int p = 0; p < rule.size(); ++p) {
        const double value = values(q, p), weight = rule.weight(q) * rule.weight(p);
        mean_z[q] += rule.weight(p) * value;
        mean_r[p] += rule.weight(q) * value;
        mean += weight * value;
        square += weight * value * value;
      }
    for (unsigned int q = 0; q < rule.size(); ++q) {
      of_z += rule.weight(q) * std::pow(mean_z[q] - mean, 2);
      of_r += rule.weight(q) * std::pow(mean_r[q] - mean, 2);
    }
    rest = std::max(0., square - mean * mean - of_z - of_r);
  }

  double mean = 0, of_z = 0, of_r = 0, rest;
};

} // namespace

ForceInterpolant::ForceInterpolant(const RingSpace& space, const Scene& scene)
    : exact(scene.uniform_force.has_value()),
      friedrichs_squared(contact_free_unit_displacement(scene.inner_radius, scene.outer_radius,
                                                        scene.outer_radius)) {
  Panel ring;
  ring.low = Point<2>(scene.inner_radius, 0);
  ring.high = Point<2>(scene.outer_radius, 2 * numbers::PI);
  panels = {ring};
  if (exact) {
    interpolate(scene, panels[0]);
    return;
  }

  const auto& triangulation = space.dof_handler().get_triangulation();
  halve_where_fine(triangulation);
  double norm_squared = 0;
  std::priority_queue<std::pair<double, unsigned int>> worst;
  const auto add = [&](unsigned int i) {
    interpolate(scene, panels[i]);
    norm_squared += panels[i].norm_squared;
    worst.push({panels[i].local_squared + panels[i].global_squared, i});
  };
  for (unsigned int i = 0; i < panels.size(); ++i)
    if (panels[i].first_half == 0)
      add(i);
  const double allowed = tolerance * tolerance * friedrichs_squared * norm_squared;
  const unsigned int most_panels = 3 * panels.size() + space.n_unknowns() / 200;
  while (!worst.empty() && worst.top().first * panels.size() > allowed &&
         panels.size() < most_panels) {
    const unsigned int i = worst.top().second;
    worst.pop();
    const unsigned int direction = rougher_direction(panels[i].coefficients);
    if (panels[i].high[direction] - panels[i].low[direction] < smallest * panels[i].high[direction])
      continue; // a jump between neighbouring numbers
    halve(i, direction);
    for (const unsigned int half : {0, 1})
      add(panels[i].first_half + half);
  }
}

void ForceInterpolant::halve_where_fine(const Triangulation<2>& triangulation) {
  std::vector<Point<2>> centers;
  for (const auto& cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned()) {
      const Point<2> center = cell->center();
      centers.emplace_back(center[0], std::fmod(center[1], 2 * numbers::PI));
    }
  const unsigned int n_cells = triangulation.n_global_active_cells();
  const unsigned int most_cells = std::max(8u, n_cells / 32);
  std::vector<std::vector<Point<2>>> own_cells = {std::move(centers)}; // of each panel
  std::vector<unsigned int> all_cells = {n_cells};
  for (unsigned int i = 0; i < panels.size(); ++i) {
    if (all_cells[i] <= most_cells)
      continue;
    const unsigned int direction = longer_direction(panels[i].low, panels[i].high);
    halve(i, direction);
    const double middle = panels.back().low[direction];
    std::vector<Point<2>> inner, outer;
    for (const Point<2>& center : own_cells[i])
      (center[direction] < middle ? inner : outer).push_back(center);
    const unsigned int n_inner =
        Utilities::MPI::sum<unsigned int>(inner.size(), triangulation.get_communicator());
    all_cells.insert(all_cells.end(), {n_inner, all_cells[i] - n_inner});
    own_cells.push_back(std::move(inner));
    own_cells.push_back(std::move(outer));
  }
}

void ForceInterpolant::halve(unsigned int number, unsigned int direction) {
  Panel inner = panels[number], outer = inner;
  inner.high[direction] = outer.low[direction] = (inner.low[direction] + inner.high[direction]) / 2;
  panels[number].first_half = panels.size();
  panels[number].direction = direction;
  panels.push_back(std::move(inner));
  panels.push_back(std::move(outer));
}

void ForceInterpolant::interpolate(const Scene& scene, Panel& panel) const {
  static const PanelPoints points;
  const Tensor<1, 2> size = panel.high - panel.low;
  const auto moment = [&](double r, double t) {
    const double z = panel.low[1] + t * size[1], f = scene.force(r, z);
    if (!std::isfinite(f))
      throw BadInput(force_not_finite_at(scene, r, z));
    return r * f;
  };
  const auto radius = [&](double t) { return panel.low[0] + t * size[0]; };

  FullMatrix<double> nodal(n), half(n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < n; ++i)
      nodal(j, i) = moment(radius(points.gauss.point(i)[0]), points.gauss.point(j)[0]);
  points.to_coefficients.mmult(half, nodal);
  panel.coefficients.reinit(n, n);
  half.mTmult(panel.coefficients, points.to_coefficients);

  if (scene.uniform_force)
    return;
  const unsigned int n_fine = points.fine.size();
  FullMatrix<double> rows(n_fine, n), missed(n_fine, n_fine);
  points.to_values.mmult(rows, panel.coefficients);
  rows.mTmult(missed, points.to_values);
  panel.norm_squared = 0;
  for (unsigned int q = 0; q < n_fine; ++q)
    for (unsigned int p = 0; p < n_fine; ++p) {
      const double r = radius(points.fine.point(p)[0]);
      const double exact_value = moment(r, points.fine.point(q)[0]);
      missed(q, p) = exact_value - missed(q, p);
      panel.norm_squared += size[0] * size[1] * points.fine.weight(p) * points.fine.weight(q) *
                            exact_value * exact_value / r;
    }
  const MeanSquares squares(missed, points.fine);
  panel.coefficients(0, 0) += squares.mean;

  // Factors of the squares; the speed may be a rounding beyond the critical one.
  const double by_norm = friedrichs_squared / panel.low[0];
  const double by_r = std::pow(size[0] / numbers::PI, 2) / panel.low[0];
  const double angular_stiffness = panel.high[0] * std::max(0., scene.alpha(panel.high[0]));
  double by_z = std::pow(size[1] / numbers::PI, 2);
  const bool is_local = by_z < by_norm * angular_stiffness;
  by_z = is_local ? by_z / angular_stiffness : by_norm;
  const double local =
      by_r * squares.of_r + (is_local ? std::min(by_r, by_z) : by_r) * squares.rest;
  const double global = by_norm * squares.mean * squares.mean;
  panel.local_squared = size[0] * size[1] * (local + (is_local ? by_z * squares.of_z : 0));
  panel.global_squared = size[0] * size[1] * (global + (is_local ? 0 : by_z * squares.of_z));
}

ForceColumn ForceInterpolant::column(double z, double begin) const {
  ForceColumn pieces;
  AngularValues angular;
  collect(0, std::fmod(z, 2 * numbers::PI), begin, angular, pieces);
  for (unsigned int i = pieces.size(); i-- > 1;)
    pieces[i - 1].outside =
        pieces[i].outside + (pieces[i].end - pieces[i].begin) * pieces[i].coefficients[0];
  return pieces;
}

void ForceInterpolant::collect(unsigned int number, double z, double begin, AngularValues& angular,
                               ForceColumn& column) const {
  const Panel& panel = panels[number];
  if (panel.high[0] <= begin)
    return;
  if (panel.first_half > 0) {
    const bool all = panel.direction == 0;
    const bool is_outer = z >= panels[panel.first_half].high[1];
    if (all || !is_outer)
      collect(panel.first_half, z, begin, angular, column);
    if (all || is_outer)
      collect(panel.first_half + 1, z, begin, angular, column);
    return;
  }
  if (angular.begin != panel.low[1] || angular.end != panel.high[1]) {
    angular.begin = panel.low[1];
    angular.end = panel.high[1];
    for (unsigned int l = 0; l < n; ++l)
      angular.legendre[l] =
          legendre()[l].value((z - angular.begin) / (angular.end - angular.begin));
  }
  ForcePiece::Coefficients coefficients = {};
  const double* of_panel = &panel.coefficients(0, 0); // by rows
  for (const double value : angular.legendre)
    for (double& coefficient : coefficients)
      coefficient += value * *of_panel++;
  column.push_back({panel.low[0], panel.high[0], coefficients, 0});
}

double ForceInterpolant::error() const {
  double local = 0, global = 0;
  for (const Panel& panel : panels)
    if (panel.first_half == 0) {
      local += panel.local_squared;
      global += panel.global_squared;
    }
  return std::sqrt(local) + std::sqrt(global);
}

} // namespace rollwave
