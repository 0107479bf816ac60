#include "force_interpolant.h"

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

/// Gauss' points of a panel in one direction, and finer ones on which f_0 is compared with f.
struct PanelPoints {
  PanelPoints() : gauss(n), fine(gauss, 2), to_coefficients(n, n), to_values(fine.size(), n) {
    for (unsigned int k = 0; k < n; ++k) {
      for (unsigned int q = 0; q < n; ++q)
        to_coefficients(k, q) = gauss.weight(q) * legendre()[k].value(gauss.point(q)[0]);
      for (unsigned int p = 0; p < fine.size(); ++p)
        to_values(p, k) = legendre()[k].value(fine.point(p)[0]);
    }
  }

  QGauss<1> gauss;
  QIterated<1> fine;
  FullMatrix<double> to_coefficients, to_values;
};

/// The direction in which a panel is longer.
unsigned int longer_direction(const Point<2>& low, const Point<2>& high) {
  return high[0] * (high[1] - low[1]) > high[0] - low[0] ? 1 : 0;
}

/// The direction in which the last two coefficients are larger.
unsigned int rougher_direction(const FullMatrix<double>& coefficients) {
  double tail[] = {0, 0};
  for (unsigned int k = 0; k < n; ++k)
    for (unsigned int l = 0; l < n; ++l) {
      const double square = coefficients(k, l) * coefficients(k, l);
      if (k + 2 >= n)
        tail[0] += square;
      if (l + 2 >= n)
        tail[1] += square;
    }
  return tail[0] > tail[1] ? 0 : 1;
}

} // namespace

ForceInterpolant::ForceInterpolant(const RingSpace& space, const Scene& scene)
    : exact(scene.uniform_force.has_value()) {
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
    worst.push({panels[i].error_squared, i});
  };
  for (unsigned int i = 0; i < panels.size(); ++i)
    if (panels[i].first_half == 0)
      add(i);
  const double allowed = tolerance * tolerance * norm_squared;
  const unsigned int most_panels = 2 * panels.size() + triangulation.n_global_active_cells() / 64;
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

void ForceInterpolant::interpolate(const Scene& scene, Panel& panel) {
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
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      nodal(i, j) = moment(radius(points.gauss.point(i)[0]), points.gauss.point(j)[0]);
  points.to_coefficients.mmult(half, nodal);
  panel.coefficients.reinit(n, n);
  half.mTmult(panel.coefficients, points.to_coefficients);

  if (scene.uniform_force)
    return;
  const unsigned int n_fine = points.fine.size();
  FullMatrix<double> rows(n_fine, n), values(n_fine, n_fine);
  points.to_values.mmult(rows, panel.coefficients);
  rows.mTmult(values, points.to_values);
  panel.error_squared = panel.norm_squared = 0;
  for (unsigned int p = 0; p < n_fine; ++p) {
    const double r = radius(points.fine.point(p)[0]);
    for (unsigned int q = 0; q < n_fine; ++q) {
      const double exact_value = moment(r, points.fine.point(q)[0]);
      const double error = exact_value - values(p, q);
      const double weight = points.fine.weight(p) * points.fine.weight(q) * size[0] * size[1] / r;
      panel.error_squared += weight * error * error;
      panel.norm_squared += weight * exact_value * exact_value;
    }
  }
}

ForceColumn ForceInterpolant::column(double z) const {
  ForceColumn pieces;
  collect(0, std::fmod(z, 2 * numbers::PI), pieces);
  for (unsigned int i = pieces.size(); i-- > 1;)
    pieces[i - 1].outside =
        pieces[i].outside + (pieces[i].end - pieces[i].begin) * pieces[i].coefficients[0];
  return pieces;
}

void ForceInterpolant::collect(unsigned int number, double z, ForceColumn& column) const {
  const Panel& panel = panels[number];
  if (panel.first_half > 0) {
    const bool all = panel.direction == 0;
    const bool is_outer = z >= panels[panel.first_half].high[1];
    if (all || !is_outer)
      collect(panel.first_half, z, column);
    if (all || is_outer)
      collect(panel.first_half + 1, z, column);
    return;
  }
  ForcePiece piece{panel.low[0], panel.high[0], {}, 0};
  const double t = (z - panel.low[1]) / (panel.high[1] - panel.low[1]);
  for (unsigned int l = 0; l < n; ++l) {
    const double value = legendre()[l].value(t);
    for (unsigned int k = 0; k < n; ++k)
      piece.coefficients[k] += panel.coefficients(k, l) * value;
  }
  column.push_back(piece);
}

double ForceInterpolant::error() const {
  double squared = 0;
  for (const Panel& panel : panels)
    if (panel.first_half == 0)
      squared += panel.error_squared;
  return std::sqrt(squared);
}

} // namespace rollwave
