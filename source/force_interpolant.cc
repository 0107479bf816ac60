#include "force_interpolant.h"

#include "interval_map.h"
#include "scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rollwave {

using namespace dealii;

ForceInterpolant::ForceInterpolant(const RingSpace& space, const Scene& scene,
                                   const std::vector<double>& moments, const RadialExtents& extents)
    : exact(scene.uniform_force.has_value()),
      panels(exact ? ForcePanels(scene) : choose_force_panels(space, scene, moments, extents)),
      negligible_error(negligible_error_of_force(space, scene, panels)) {}

ForceColumn ForceInterpolant::column(double z, double begin) const {
  z = std::fmod(z, 2 * numbers::PI);
  return panels.column(panels.on(z, begin), z, panels[0].high[0]);
}

std::vector<ForceColumn> ForceInterpolant::columns(double begin, double end,
                                                   const Quadrature<1>& rule,
                                                   const RadialExtent& radii) const {
  std::vector<ForceColumn> lines;
  std::vector<unsigned int> panels_there;
  double low = 0, high = 0; // where these are the panels
  for (const auto& point : rule.get_points()) {
    const double z = std::fmod(begin + (end - begin) * point[0], 2 * numbers::PI);
    if (z < low || z >= high) {
      panels_there = panels.on(z, radii.begin);
      low = 0;
      high = panels[0].high[1];
      for (const unsigned int i : panels_there) {
        low = std::max(low, panels[i].low[1]);
        high = std::min(high, panels[i].high[1]);
      }
    }
    lines.push_back(panels.column(panels_there, z, radii.end));
  }
  return lines;
}

double ForceInterpolant::missed_along_z(double begin, double end, const FinerRule& rules,
                                        const RadialExtent& radii) const {
  const auto angles = [&](const Quadrature<1>& rule) {
    std::vector<double> z;
    for (const auto& point : rule.get_points())
      z.push_back(std::fmod(begin + (end - begin) * point[0], 2 * numbers::PI));
    return z;
  };
  const std::vector<double> of_rule = angles(rules.rule), of_fine = angles(rules.fine);
  const std::vector<unsigned int> line = panels.on(of_fine.front(), radii.begin);
  const auto missed_norms_on = [&](double low, double high) {
    const auto values = [&](const std::vector<double>& z) {
      std::vector<ForcePiece::Coefficients> all;
      for (const double angle : z)
        all.push_back(legendre_values((angle - low) / (high - low)));
      return all;
    };
    const auto on_rule = values(of_rule), on_fine = values(of_fine);
    ForcePiece::Coefficients missed_norms;
    for (unsigned int l = 0; l < ForcePiece::n_coefficients; ++l) {
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
    const ForcePanel& panel = panels[line[s]];
    if (panel.n_rows <= rules.rule.size()) // the rule sees them all
      continue;
    const auto& norms = missed_norms.at(
        panel.low[1], panel.high[1], [&] { return missed_norms_on(panel.low[1], panel.high[1]); });
    ForcePiece::Coefficients missed = {};
    for (unsigned int l = rules.rule.size(); l < panel.n_rows; ++l)
      for (unsigned int k = 0; k < ForcePiece::n_coefficients; ++k)
        missed[k] += norms[l] * std::abs(panel.coefficients(l, k));
    // Legendre polynomials other than the first have no mean: |int_t^1 L_k| <= (t (1 - t))^(1/2).
    const double within = std::accumulate(missed.begin(), missed.end(), missed[0]) / 2;
    const double height = panel.high[0] - panel.low[0];
    if (panel.low[0] < radii.end)
      largest = std::max(largest, outside + height * within);
    outside += height * missed[0];
    largest = std::max(largest, outside);
  }
  return largest;
}

double ForceInterpolant::error() const {
  double local = 0, global = 0;
  std::vector<double> angles = {2 * numbers::PI};
  for (unsigned int i = 0; i < panels.size(); ++i)
    if (panels.is_part(i)) {
      local += panels[i].missed.local_squared;
      global += panels[i].missed.global_squared;
      angles.push_back(panels[i].low[1]);
    }
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
  double of_means = 0;
  for (unsigned int j = 0; j + 1 < angles.size(); ++j) {
    const std::vector<unsigned int> line = panels.on((angles[j] + angles[j + 1]) / 2, 0);
    double outer = 0;
    for (unsigned int k = line.size(); k-- > 0;) {
      const ForcePanel& panel = panels[line[k]];
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
