#include "force_interpolant.h"

#include "contact_free.h"
#include "errors.h"
#include "interval_map.h"
#include "scene.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

constexpr unsigned int n = ForcePiece::n_coefficients;
constexpr double round_off = 1e-13; ///< of f_0
constexpr double smallest = 4e-15;  ///< panel, over its distance from the origin

/// Gauss' points of a panel in one direction, and more on which f_0 is compared with f.
struct PanelPoints {
  PanelPoints() : gauss(n), fine(3 * n / 2), to_coefficients(n, n), to_values(fine.size(), n) {
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

  QGauss<1> gauss, fine;
  FullMatrix<double> to_coefficients, to_values;
};

const PanelPoints& points() {
  static const PanelPoints all;
  return all;
}

} // namespace

/// The mean of what is given at the points of a product of a rule, and the mean squares of its
/// parts without it: a function of z (rows), a function of r (columns), and the rest.
struct ForceInterpolant::MeanSquares {
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

ForceInterpolant::ForceInterpolant(const RingSpace& space, const Scene& scene)
    : exact(scene.uniform_force.has_value()),
      friedrichs_squared(contact_free_unit_displacement(scene.inner_radius, scene.outer_radius,
                                                        scene.outer_radius)) {
  Panel ring;
  ring.low = Point<2>(scene.inner_radius, 0);
  ring.high = Point<2>(scene.outer_radius, 2 * numbers::PI);
  interpolate(scene, ring);
  panels = {ring};
  if (exact)
    return;

  halve_where_fine(scene, space);
  std::priority_queue<std::pair<double, unsigned int>> worst;
  const auto add = [&](unsigned int i) {
    judge(scene, panels[i]);
    worst.push({squared_alone(panels[i], panels[i].missed), i});
  };
  for (unsigned int i = 0; i < panels.size(); ++i)
    if (panels[i].first_half == 0)
      add(i);
  const double norm = friedrichs_norm();
  const unsigned int most_panels = panels.size() + 16 + space.n_unknowns() / 100;
  const unsigned int degree = space.dof_handler().get_fe().degree;
  negligible_error = 0.01 * std::pow(space.n_unknowns(), -0.5 * degree) * norm;
  const double negligible_squared = std::pow(negligible_error, 2) / most_panels;
  const double allowed_squared =
      std::max(std::pow(round_off * norm, 2) / most_panels, 1e-10 * negligible_squared);
  while (!worst.empty() && panels.size() < most_panels) {
    const auto [error_squared, i] = worst.top();
    worst.pop();
    const Missed& beside_mean = panels[i].beside_mean;
    const bool is_resolved =
        panels[i].missed.varying_squared() <= beside_mean.varying_squared() / 100;
    if (is_resolved && error_squared <= allowed_squared)
      continue;
    if (squared_alone(panels[i], beside_mean) <= negligible_squared) {
      if (!is_resolved)
        flatten(panels[i]);
      continue;
    }
    const unsigned int direction = rougher_direction(panels[i]);
    if (panels[i].high[direction] - panels[i].low[direction] < smallest * panels[i].high[direction])
      continue; // a jump between neighbouring numbers
    halve(scene, i, direction);
    for (const unsigned int half : {0, 1})
      add(panels[i].first_half + half);
  }
}

void ForceInterpolant::halve_where_fine(const Scene& scene, const RingSpace& space) {
  const auto& triangulation = space.dof_handler().get_triangulation();
  std::vector<Point<2>> centers;
  for (const auto& cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned()) {
      const Point<2> center = cell->vertex(0) + (cell->vertex(3) - cell->vertex(0)) / 2;
      const double period = center[1] < 2 * numbers::PI ? 0 : 2 * numbers::PI;
      centers.emplace_back(center[0], center[1] - period);
    }
  const unsigned int n_cells = triangulation.n_global_active_cells();
  const double most_cells = n_cells * std::max(1. / 32, 128. / space.n_unknowns());
  struct Cells {
    std::vector<Point<2>>::iterator begin, end; ///< of the own centers on a panel
    unsigned int n_all;                         ///< on all processes
  };
  std::vector<Cells> cells = {{centers.begin(), centers.end(), n_cells}};
  for (unsigned int i = 0; i < panels.size(); ++i) {
    const Cells whole = cells[i];
    if (whole.n_all <= most_cells)
      continue;
    unsigned int direction = rougher_direction(panels[i]);
    const Tensor<1, 2> size = panels[i].high - panels[i].low, all = panels[0].high - panels[0].low;
    if (16 * size[direction] / all[direction] < size[1 - direction] / all[1 - direction])
      direction = 1 - direction; // does not reach single cells along a jump
    halve(scene, i, direction);
    const double middle = panels.back().low[direction];
    const auto outer = std::partition(
        whole.begin, whole.end, [&](const Point<2>& center) { return center[direction] < middle; });
    const unsigned int n_inner =
        Utilities::MPI::sum<unsigned int>(outer - whole.begin, triangulation.get_communicator());
    cells.push_back({whole.begin, outer, n_inner});
    cells.push_back({outer, whole.end, whole.n_all - n_inner});
  }
}

unsigned int ForceInterpolant::rougher_direction(const Panel& panel) {
  double tail[] = {0, 0}, all = 0;
  for (unsigned int l = 0; l < n; ++l)
    for (unsigned int k = 0; k < n; ++k) {
      const double square = panel.coefficients(l, k) * panel.coefficients(l, k);
      all += square;
      if (k + 2 >= n)
        tail[0] += square;
      if (l + 2 >= n)
        tail[1] += square;
    }
  if (std::max(tail[0], tail[1]) <= round_off * round_off * all) {
    const Tensor<1, 2> size = panel.high - panel.low;
    return panel.high[0] * size[1] > size[0] ? 1 : 0;
  }
  return tail[0] > tail[1] ? 0 : 1;
}

void ForceInterpolant::halve(const Scene& scene, unsigned int number, unsigned int direction) {
  Panel inner = panels[number], outer = inner;
  inner.high[direction] = outer.low[direction] = (inner.low[direction] + inner.high[direction]) / 2;
  panels[number].first_half = panels.size();
  panels[number].direction = direction;
  for (Panel* half : {&inner, &outer}) {
    interpolate(scene, *half);
    panels.push_back(std::move(*half));
  }
}

double ForceInterpolant::moment(const Scene& scene, const Panel& panel, const Point<2>& share) {
  const double r = panel.low[0] + share[0] * (panel.high[0] - panel.low[0]);
  const double z = panel.low[1] + share[1] * (panel.high[1] - panel.low[1]);
  const double f = scene.force(r, z);
  if (!std::isfinite(f))
    throw BadInput(force_not_finite_at(scene, r, z));
  return r * f;
}

void ForceInterpolant::interpolate(const Scene& scene, Panel& panel) {
  FullMatrix<double> nodal(n), half(n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < n; ++i)
      nodal(j, i) = moment(scene, panel, {points().gauss.point(i)[0], points().gauss.point(j)[0]});
  points().to_coefficients.mmult(half, nodal);
  panel.coefficients.reinit(n, n);
  half.mTmult(panel.coefficients, points().to_coefficients);

  double largest[n] = {}; // of each row
  for (unsigned int l = 0; l < n; ++l)
    for (unsigned int k = 0; k < n; ++k)
      largest[l] = std::max(largest[l], std::abs(panel.coefficients(l, k)));
  const double negligible = 1e-15 * *std::max_element(largest, largest + n);
  panel.n_rows = n;
  while (panel.n_rows > 1 && largest[panel.n_rows - 1] <= negligible)
    --panel.n_rows;
}

void ForceInterpolant::judge(const Scene& scene, Panel& panel) const {
  const QGauss<1>& rule = points().fine;
  FullMatrix<double> rows(rule.size(), n), missed(rule.size()), all(rule.size());
  points().to_values.mmult(rows, panel.coefficients);
  rows.mTmult(missed, points().to_values);
  const Tensor<1, 2> size = panel.high - panel.low;
  panel.norm_squared = 0;
  for (unsigned int q = 0; q < rule.size(); ++q)
    for (unsigned int p = 0; p < rule.size(); ++p) {
      all(q, p) = moment(scene, panel, {rule.point(p)[0], rule.point(q)[0]});
      missed(q, p) = all(q, p) - missed(q, p);
      panel.norm_squared += size[0] * size[1] * rule.weight(p) * rule.weight(q) * all(q, p) *
                            all(q, p) / (panel.low[0] + rule.point(p)[0] * size[0]);
    }
  const MeanSquares of_missed(missed, rule), of_all(all, rule);
  panel.coefficients(0, 0) += of_missed.mean;
  panel.missed = weigh(scene, panel, of_missed, std::abs(of_missed.mean));
  panel.beside_mean =
      weigh(scene, panel, of_all, std::sqrt(of_all.of_z + of_all.of_r + of_all.rest));
}

ForceInterpolant::Missed ForceInterpolant::weigh(const Scene& scene, const Panel& panel,
                                                 const MeanSquares& squares, double mean) const {
  const Tensor<1, 2> size = panel.high - panel.low;
  // Factors of the squares; the speed may be a rounding beyond the critical one.
  const double by_r = std::pow(size[0] / numbers::PI, 2) / panel.low[0];
  const double by_norm = friedrichs_squared / panel.low[0];
  const double angular_stiffness = panel.high[0] * std::max(0., scene.alpha(panel.high[0]));
  double by_z = std::pow(size[1] / numbers::PI, 2);
  const bool is_local = by_z < by_norm * angular_stiffness;
  by_z = is_local ? by_z / angular_stiffness : by_norm;
  const double of_z = size[0] * size[1] * by_z * squares.of_z;
  const double local =
      by_r * squares.of_r + (is_local ? std::min(by_r, by_z) : by_r) * squares.rest;
  return {mean, size[0] * size[1] * local + (is_local ? of_z : 0), is_local ? 0 : of_z};
}

double ForceInterpolant::squared_alone(const Panel& panel, const Missed& missed) const {
  const Tensor<1, 2> size = panel.high - panel.low;
  const double by_integral = size[0] * log_of_ratio(panel.high[0], panels[0].low[0]);
  return missed.varying_squared() + size[0] * size[1] * by_integral * missed.mean * missed.mean;
}

void ForceInterpolant::flatten(Panel& panel) {
  const double mean = panel.coefficients(0, 0);
  panel.coefficients = 0;
  panel.coefficients(0, 0) = mean;
  panel.n_rows = 1;
  panel.missed = panel.beside_mean;
}

ForceColumn ForceInterpolant::column(double z, double begin) const {
  z = std::fmod(z, 2 * numbers::PI);
  return column_on(panels_on(z, begin), z);
}

std::vector<ForceColumn> ForceInterpolant::columns(double begin, double end,
                                                   const Quadrature<1>& rule) const {
  std::vector<ForceColumn> lines;
  std::vector<unsigned int> panels_there;
  double low = 0, high = 0; // where these are the panels
  for (const auto& point : rule.get_points()) {
    const double z = std::fmod(begin + (end - begin) * point[0], 2 * numbers::PI);
    if (z < low || z >= high) {
      panels_there = panels_on(z, 0);
      low = 0;
      high = panels[0].high[1];
      for (const unsigned int i : panels_there) {
        low = std::max(low, panels[i].low[1]);
        high = std::min(high, panels[i].high[1]);
      }
    }
    lines.push_back(column_on(panels_there, z));
  }
  return lines;
}

ForceColumn ForceInterpolant::column_on(const std::vector<unsigned int>& line, double z) const {
  ForceColumn pieces;
  pieces.reserve(line.size());
  double angular_begin = 0, angular_end = 0; // which many panels along r have in common
  ForcePiece::Coefficients angular = {};
  for (const unsigned int i : line) {
    const Panel& panel = panels[i];
    if (angular_begin != panel.low[1] || angular_end != panel.high[1]) {
      angular_begin = panel.low[1];
      angular_end = panel.high[1];
      angular = legendre_values((z - angular_begin) / (angular_end - angular_begin));
    }
    pieces.push_back({panel.low[0], panel.high[0], {}, 0});
    for (unsigned int l = 0; l < panel.n_rows; ++l)
      for (unsigned int k = 0; k < n; ++k)
        pieces.back().coefficients[k] += angular[l] * panel.coefficients(l, k);
  }
  for (unsigned int i = pieces.size(); i-- > 1;)
    pieces[i - 1].outside =
        pieces[i].outside + (pieces[i].end - pieces[i].begin) * pieces[i].coefficients[0];
  return pieces;
}

std::vector<double> ForceInterpolant::panel_ends(double begin, double end) const {
  std::vector<double> ends;
  const double period = panels[0].high[1];
  double turn = std::floor(begin / period) * period;
  for (double z = begin - turn;;) {
    double next = period;
    for (const unsigned int i : panels_on(z, 0))
      next = std::min(next, panels[i].high[1]);
    if (turn + next >= end)
      return ends;
    ends.push_back(turn + next);
    z = next;
    if (next == period) {
      turn += period;
      z = 0;
    }
  }
}

double ForceInterpolant::missed_along_z(double begin, double end, const HalvedRule& rules) const {
  const auto angles = [&](const Quadrature<1>& rule) {
    std::vector<double> z;
    for (const auto& point : rule.get_points())
      z.push_back(std::fmod(begin + (end - begin) * point[0], 2 * numbers::PI));
    return z;
  };
  const std::vector<double> of_rule = angles(rules.rule), of_fine = angles(rules.fine);
  const std::vector<unsigned int> line = panels_on(of_fine.front(), 0);
  const auto missed_norms_on = [&](double low, double high) {
    const auto values = [&](const std::vector<double>& z) {
      std::vector<ForcePiece::Coefficients> all;
      for (const double angle : z)
        all.push_back(legendre_values((angle - low) / (high - low)));
      return all;
    };
    const auto on_rule = values(of_rule), on_fine = values(of_fine);
    ForcePiece::Coefficients missed_norms;
    for (unsigned int l = 0; l < n; ++l) {
      double square = 0;
      for (unsigned int p = 0; p < of_fine.size(); ++p) {
        double missed = on_fine[p][l];
        for (unsigned int i = 0; i < of_rule.size(); ++i)
          missed -= rules.interpolation(p, i) * on_rule[i][l];
        square += rules.fine.weight(p) * missed * missed;
      }
      missed_norms[l] = std::sqrt(square);
    }
    return missed_norms;
  };
  IntervalMap<ForcePiece::Coefficients> missed_norms; // of which many panels have one in common
  double outside = 0, largest = 0;
  for (unsigned int s = line.size(); s-- > 0;) {
    const Panel& panel = panels[line[s]];
    if (panel.n_rows <= rules.rule.size()) // the rule sees them all
      continue;
    const auto& norms = missed_norms.at(
        panel.low[1], panel.high[1], [&] { return missed_norms_on(panel.low[1], panel.high[1]); });
    ForcePiece::Coefficients missed = {};
    for (unsigned int l = rules.rule.size(); l < panel.n_rows; ++l)
      for (unsigned int k = 0; k < n; ++k)
        missed[k] += norms[l] * std::abs(panel.coefficients(l, k));
    // Legendre polynomials other than the first have no mean: |int_t^1 L_k| <= (t (1 - t))^(1/2).
    const double within = std::accumulate(missed.begin(), missed.end(), missed[0]) / 2;
    const double height = panel.high[0] - panel.low[0];
    largest = std::max(largest, outside + height * within);
    outside += height * missed[0];
  }
  return largest;
}

std::vector<unsigned int> ForceInterpolant::panels_on(double z, double begin) const {
  std::vector<unsigned int> line;
  line.reserve(32);
  collect(0, z, begin, line);
  return line;
}

void ForceInterpolant::collect(unsigned int number, double z, double begin,
                               std::vector<unsigned int>& line) const {
  const Panel& panel = panels[number];
  if (panel.high[0] <= begin)
    return;
  if (panel.first_half == 0) {
    line.push_back(number);
    return;
  }
  const bool all = panel.direction == 0, is_inner = z < panels[panel.first_half].high[1];
  if (all || is_inner)
    collect(panel.first_half, z, begin, line);
  if (all || !is_inner)
    collect(panel.first_half + 1, z, begin, line);
}

double ForceInterpolant::friedrichs_norm() const {
  double norm_squared = 0;
  for (const Panel& panel : panels)
    if (panel.first_half == 0)
      norm_squared += panel.norm_squared;
  return std::sqrt(friedrichs_squared * norm_squared);
}

double ForceInterpolant::error() const {
  double local = 0, global = 0;
  std::vector<double> angles = {2 * numbers::PI};
  for (const Panel& panel : panels)
    if (panel.first_half == 0) {
      local += panel.missed.local_squared;
      global += panel.missed.global_squared;
      angles.push_back(panel.low[1]);
    }
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
  double of_means = 0;
  for (unsigned int j = 0; j + 1 < angles.size(); ++j) {
    const std::vector<unsigned int> line = panels_on((angles[j] + angles[j + 1]) / 2, 0);
    double outer = 0;
    for (unsigned int k = line.size(); k-- > 0;) {
      const Panel& panel = panels[line[k]];
      const double height = panel.high[0] - panel.low[0],
                   inner = outer + height * panel.missed.mean;
      of_means += (angles[j + 1] - angles[j]) * height / panel.low[0] *
                  (outer * outer + outer * inner + inner * inner) / 3;
      outer = inner;
    }
  }
  return std::sqrt(local) + std::sqrt(global) + std::sqrt(of_means);
}

} // namespace rollwave
