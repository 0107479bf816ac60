#include "potential_kinks.h"

#include "force_integrals.h"

#include <deal.II/base/quadrature_lib.h>

namespace rollwave {

using namespace dealii;

PotentialKinks::PotentialKinks(const ForceJumps& jumps, double begin, double end,
                               const std::vector<double>& nodes)
    : length(end - begin) {
  const auto inside = jumps.within(begin, end);
  if (inside.empty())
    return;
  ForceAtRadii at_nodes(nodes);
  std::vector<double> before;
  for (const auto& [z, jump] : inside) {
    at_nodes.integrals(jump->before, before);
    kinks.push_back({(z - begin) / length, {}});
    std::vector<double>& g = kinks.back().jump;
    at_nodes.integrals(jump->after, g);
    for (unsigned int i = 0; i < g.size(); ++i)
      g[i] = jump->share * (g[i] - before[i]);
  }
}

void PotentialKinks::add_to(double t, double* values, double* derivatives) const {
  for (const auto& [kink, jump] : kinks) {
    const double value = length * (t > kink ? (1 - t) * -kink : (1 - kink) * -t);
    const double derivative = t > kink ? kink : kink - 1;
    for (unsigned int i = 0; i < jump.size(); ++i) {
      values[i] += value * jump[i];
      derivatives[i] += derivative * jump[i];
    }
  }
}

std::optional<PotentialKinks> kinks_of_cell(const ForceJumps& jumps, const Point<2>& low,
                                            const Point<2>& high, unsigned int degree) {
  if (jumps.within(low[1], high[1]).empty())
    return std::nullopt;
  std::vector<double> nodes;
  const QGaussLobatto<1> lobatto(degree + 1);
  for (const Point<1>& node : lobatto.get_points())
    nodes.push_back(low[0] + node[0] * (high[0] - low[0]));
  return PotentialKinks(jumps, low[1], high[1], nodes);
}

} // namespace rollwave
