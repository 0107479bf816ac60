#include "force_panels.h"

#include "scene.h"
#include "straight_jump.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rollwave {

using namespace dealii;

ForcePanels::ForcePanels(const Scene& scene) {
  nodes.push_back({ForcePanel(scene, Point<2>(scene.inner_radius, 0),
                              Point<2>(scene.outer_radius, 2 * numbers::PI))});
}

unsigned int ForcePanels::cut(const Scene& scene, unsigned int number, unsigned int direction,
                              double place) {
  const ForcePanel& whole = nodes[number].panel;
  Point<2> low = whole.low, high = whole.high;
  low[direction] = high[direction] = place;
  ForcePanel inner(scene, whole.low, high), outer(scene, low, whole.high);
  const unsigned int number_of_inner = nodes.size();
  nodes[number].inner = number_of_inner;
  nodes[number].direction = direction;
  nodes.push_back({std::move(inner)});
  nodes.push_back({std::move(outer)});
  return number_of_inner;
}

unsigned int ForcePanels::halve(const Scene& scene, unsigned int number, unsigned int direction) {
  const ForcePanel& whole = nodes[number].panel;
  return cut(scene, number, direction, (whole.low[direction] + whole.high[direction]) / 2);
}

std::vector<unsigned int> ForcePanels::on(double z, double begin) const {
  std::vector<unsigned int> line;
  line.reserve(32);
  collect(0, z, begin, line);
  return line;
}

void ForcePanels::collect(unsigned int number, double z, double begin,
                          std::vector<unsigned int>& line) const {
  const auto& [panel, inner, direction] = nodes[number];
  if (panel.high[0] <= begin)
    return;
  if (inner == 0) {
    line.push_back(number);
    return;
  }
  const bool both = direction == 0, is_inner = z < nodes[inner].panel.high[1];
  if (both || is_inner)
    collect(inner, z, begin, line);
  if (both || !is_inner)
    collect(inner + 1, z, begin, line);
}

ForceColumn ForcePanels::column(const std::vector<unsigned int>& line, double z, double end) const {
  ForceColumn pieces;
  const auto inner_end = std::partition_point(
      line.begin(), line.end(), [&](unsigned int i) { return nodes[i].panel.low[0] < end; });
  pieces.reserve(inner_end - line.begin());
  double outside = 0;
  double angular_begin = 0, angular_end = 0; // which many panels along r have in common
  ForcePiece::Coefficients angular = {};
  for (auto i = line.begin(); i != line.end(); ++i) {
    const ForcePanel& panel = nodes[*i].panel;
    if (angular_begin != panel.low[1] || angular_end != panel.high[1]) {
      angular_begin = panel.low[1];
      angular_end = panel.high[1];
      angular = legendre_values((z - angular_begin) / (angular_end - angular_begin));
    }
    if (i >= inner_end) {
      for (unsigned int l = 0; l < panel.n_rows; ++l)
        outside += (panel.high[0] - panel.low[0]) * angular[l] * panel.coefficients(l, 0);
      continue;
    }
    pieces.push_back({panel.low[0], panel.high[0], {}, 0});
    for (unsigned int l = 0; l < panel.n_rows; ++l)
      for (unsigned int k = 0; k < ForcePiece::n_coefficients; ++k)
        pieces.back().coefficients[k] += angular[l] * panel.coefficients(l, k);
  }
  for (unsigned int i = pieces.size(); i-- > 0;) {
    pieces[i].outside = outside;
    outside += (pieces[i].end - pieces[i].begin) * pieces[i].coefficients[0];
  }
  return pieces;
}

std::vector<double> ForcePanels::ends(double begin, double end, double radius) const {
  std::vector<double> angles;
  const double period = nodes[0].panel.high[1];
  double turn = std::floor(begin / period) * period;
  for (double z = begin - turn;;) {
    double next = period;
    for (const unsigned int i : on(z, radius))
      next = std::min(next, nodes[i].panel.high[1]);
    if (turn + next >= end)
      return angles;
    angles.push_back(turn + next);
    z = next;
    if (next == period) {
      turn += period;
      z = 0;
    }
  }
}

std::vector<double> ForcePanels::jumps(const Scene& scene) const {
  double size = 0;
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (is_part(i))
      size = std::max(size, nodes[i].panel.size_of_force());
  std::vector<double> angles;
  for (unsigned int i = 0; i < nodes.size(); ++i) {
    const ForcePanel& panel = nodes[i].panel;
    const double begin = panel.low[1], length = panel.high[1] - begin;
    const double end_before = begin > 0 ? begin : nodes[0].panel.high[1];
    if (is_part(i) && jumps_between(scene, panel.low, panel.high, 1,
                                    point_within(end_before - length, end_before, 1),
                                    point_within(begin, panel.high[1], 0), size))
      angles.push_back(begin);
  }
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
  return angles;
}

double ForcePanels::friedrichs_norm(const Scene& scene) const {
  double norm_squared = 0;
  for (unsigned int i = 0; i < size(); ++i)
    if (is_part(i))
      norm_squared += nodes[i].panel.norm_squared;
  return std::sqrt(friedrichs_squared(scene) * norm_squared);
}

} // namespace rollwave
