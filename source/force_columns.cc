#include "force_columns.h"

namespace rollwave {

const std::vector<ForceColumn>& ForceColumns::on(double begin, double end) {
  return columns.at(begin, end, [&] { return force.columns(begin, end, rule); });
}

ForceAtRadii& ForceColumns::at_radii(double begin, double end, const RadialShapes& radial) {
  return known_radii.at(begin, end, [&] { return ForceAtRadii(radial.r); });
}

const std::vector<double>& ForceColumns::equal_integrals(double begin, double end,
                                                         const RadialShapes& radial) {
  return known_integrals.at(begin, end, [&] {
    std::vector<double> integrals;
    at_radii(begin, end, radial).integrals(force.column(0), integrals);
    return integrals;
  });
}

ForceLoads& ForceColumns::loads(double begin, double end, const RadialShapes& radial) {
  return known_loads.at(begin, end, [&] { return ForceLoads(radial); });
}

} // namespace rollwave
