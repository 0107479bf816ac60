#include "force_jumps.h"

#include "force_integrals.h"
#include "scene.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace rollwave {

namespace {

constexpr double period = 2 * dealii::numbers::PI;

double share_of_kinks(const Scene& scene, const ForceJump& jump, const RadialExtents& extents) {
  constexpr unsigned int n_parts = 16;
  double unkinked = 0, kinked = 0;
  std::vector<double> before, after;
  for (const CellColumn& column : extents.around(jump.z)) {
    const double length = column.end - column.begin, t = (jump.z - column.begin) / length;
    const double dr = (column.radii.end - column.radii.begin) / n_parts;
    std::vector<double> radii;
    for (unsigned int i = 0; i <= n_parts; ++i)
      radii.push_back(column.radii.begin + i * dr);
    ForceAtRadii at_radii(radii);
    at_radii.integrals(jump.before, before);
    at_radii.integrals(jump.after, after);
    for (unsigned int i = 0; i < n_parts; ++i) {
      const double inner = after[i] - before[i], outer = after[i + 1] - before[i + 1];
      const double r = (radii[i] + radii[i + 1]) / 2;
      unkinked += t * (1 - t) * length * (inner * inner + outer * outer) / 2 * dr / r;
      kinked += std::pow(t * (1 - t), 2) * std::pow(length, 3) * std::pow(inner - outer, 2) /
                (3 * r * scene.alpha(r) * dr);
    }
  }
  return kinked > 0 ? unkinked / (unkinked + kinked) : 1;
}

} // namespace

ForceJumps::ForceJumps(const ForceInterpolant& force, const Scene& scene,
                       const RadialExtents& extents) {
  for (const double z : force.jumps(scene)) {
    jumps.push_back({z, force.column(std::nextafter(z > 0 ? z : period, 0)), force.column(z), 0});
    jumps.back().share = share_of_kinks(scene, jumps.back(), extents);
  }
}

std::vector<std::pair<double, const ForceJump*>> ForceJumps::within(double begin,
                                                                    double end) const {
  std::vector<std::pair<double, const ForceJump*>> inside;
  for (double turn = std::floor(begin / period) * period; turn < end; turn += period) {
    auto jump = std::partition_point(jumps.begin(), jumps.end(),
                                     [&](const ForceJump& jump) { return turn + jump.z <= begin; });
    for (; jump != jumps.end() && turn + jump->z < end; ++jump)
      inside.emplace_back(turn + jump->z, &*jump);
  }
  return inside;
}

} // namespace rollwave
