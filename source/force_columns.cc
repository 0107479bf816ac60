#include "force_columns.h"

#include "contact_free.h"
#include "scene.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

namespace {

/// The rule and those with more points, each with the one that is exact where no panel ends.
std::vector<FinerRule> rules_from(const QGauss<1>& gauss) {
  const QGauss<1> fine(std::max<unsigned int>(ForcePiece::n_coefficients, gauss.size()));
  std::vector<FinerRule> rules = {{gauss, fine}};
  for (unsigned int n = gauss.size() + 1; n < fine.size(); ++n)
    rules.emplace_back(QGauss<1>(n), fine);
  return rules;
}

} // namespace

ForceColumns::ForceColumns(const Scene& scene, const ForceInterpolant& force,
                           const QGauss<1>& gauss, const RadialExtents& extents,
                           const ForceJumps& jumps)
    : force(force), extents(extents), jumps(jumps), gauss(rules_from(gauss)),
      // of (int w^2 / r dr dz)^(1/2) over the ring
      negligible(
          force.negligible() /
          std::sqrt(2 * numbers::PI * log_of_ratio(scene.outer_radius, scene.inner_radius))) {}

const ForceLines& ForceColumns::on(double begin, double end) {
  return lines.at(begin, end, [&] {
    return ForceLines(force, begin, end, gauss, jumps.within(begin, end).empty() ? negligible : 0,
                      extents.of(begin, end));
  });
}

ForceLoads& ForceColumns::loads(double begin, double end, const RadialShapes& radial) {
  return known_loads.at(begin, end, [&] { return ForceLoads(radial); });
}

} // namespace rollwave
