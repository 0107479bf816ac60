#include "force_lines.h"

#include "force_integrals.h"
#include "interpolation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

constexpr unsigned int n = ForcePiece::n_coefficients;

Quadrature<1> rule_between(const std::vector<double>& ends, const Quadrature<1>& on_long) {
  static const QGauss<1> on_short(3);
  constexpr double short_part = 0.01;
  std::vector<Point<1>> points;
  std::vector<double> weights;
  for (unsigned int part = 0; part + 1 < ends.size(); ++part) {
    const double share = ends[part + 1] - ends[part];
    const Quadrature<1>& gauss = share < short_part ? on_short : on_long;
    for (unsigned int q = 0; q < gauss.size(); ++q) {
      points.emplace_back(ends[part] + share * gauss.point(q)[0]);
      weights.push_back(share * gauss.weight(q));
    }
  }
  return {points, weights};
}

/// The piece between two of its radii, by the Legendre polynomials there.
ForcePiece::Coefficients coefficients_between(const ForcePiece& piece, double begin, double end) {
  if (begin == piece.begin && end == piece.end)
    return piece.coefficients;
  static const QGauss<1> gauss(n);
  ForcePiece::Coefficients coefficients = {};
  for (unsigned int q = 0; q < n; ++q) {
    const double r = begin + gauss.point(q)[0] * (end - begin);
    const auto there = legendre_values((r - piece.begin) / (piece.end - piece.begin)),
               here = legendre_values(gauss.point(q)[0]);
    const double value =
        std::inner_product(there.begin(), there.end(), piece.coefficients.begin(), 0.);
    for (unsigned int k = 0; k < n; ++k)
      coefficients[k] += gauss.weight(q) * value * here[k];
  }
  return coefficients;
}

/// The radii where any of the columns has an end, as far as all reach and it is asked for.
std::vector<double> all_radii(const std::vector<ForceColumn>& columns,
                              const std::vector<ForceColumn>& others, RadialExtent extent) {
  for (const auto* some : {&columns, &others})
    for (const ForceColumn& column : *some) {
      extent.begin = std::max(extent.begin, column.front().begin);
      extent.end = std::min(extent.end, column.back().end);
    }
  std::vector<double> radii = {extent.begin, extent.end};
  for (const auto* some : {&columns, &others})
    for (const ForceColumn& column : *some)
      for (const ForcePiece& piece : column)
        if (extent.begin < piece.end && piece.end < extent.end)
          radii.push_back(piece.end);
  std::sort(radii.begin(), radii.end());
  radii.erase(std::unique(radii.begin(), radii.end()), radii.end());
  return radii;
}

} // namespace

ForceLines::ForceLines(const ForceInterpolant& force, double begin, double end,
                       const std::vector<FinerRule>& gauss, double negligible,
                       const RadialExtent& radii)
    : ends({0}) {
  for (const double z : force.panel_ends(begin, end, radii.begin))
    ends.push_back((z - begin) / (end - begin));
  ends.push_back(1);
  const Quadrature<1>& of_cell = gauss.front().rule;
  const auto take = [&](const Quadrature<1>& some, std::vector<ForceColumn> on_some,
                        double missed) {
    rule = some;
    columns = std::move(on_some);
    missed_mean_square = missed * missed;
    if (&some == &of_cell)
      ends.clear();
  };
  const auto columns_on = [&](const Quadrature<1>& some) {
    return force.columns(begin, end, some, radii);
  };
  if (ends.size() == 2)
    for (const FinerRule& some : gauss) {
      const double missed = force.missed_along_z(begin, end, some, radii);
      if (missed <= negligible) {
        take(some.rule, columns_on(some.rule), missed);
        return;
      }
    }
  const Quadrature<1> exact = rule_between(ends, gauss.front().fine);
  std::vector<ForceColumn> on_exact = columns_on(exact);
  if (ends.size() > 2) {
    std::vector<ForceColumn> on_cell = columns_on(of_cell);
    const double missed = rollwave::missed_along_z(exact, on_exact, of_cell, on_cell, radii);
    if (missed <= negligible) {
      take(of_cell, std::move(on_cell), missed);
      return;
    }
  }
  take(exact, std::move(on_exact), 0);
}

double missed_along_z(const Quadrature<1>& rule, const std::vector<ForceColumn>& columns,
                      const Quadrature<1>& other, const std::vector<ForceColumn>& others,
                      const RadialExtent& extent) {
  const FullMatrix<double> from_others = interpolation(other, rule);
  const std::vector<double> radii = all_radii(columns, others, extent);
  std::vector<unsigned int> piece(columns.size()), piece_of_other(others.size());
  std::vector<ForcePiece::Coefficients> of_others(others.size());
  ForceAtRadii at_end({radii.back()});
  const auto integral_beyond = [&at_end](const ForceColumn& column) {
    std::vector<double> value;
    at_end.integrals(column, value);
    return value.front();
  };
  std::vector<double> others_beyond(others.size());
  std::transform(others.begin(), others.end(), others_beyond.begin(), integral_beyond);
  double outside_squared = 0;
  for (unsigned int p = 0; p < columns.size(); ++p) {
    double missed = integral_beyond(columns[p]);
    for (unsigned int i = 0; i < others.size(); ++i)
      missed -= from_others(p, i) * others_beyond[i];
    outside_squared += rule.weight(p) * missed * missed;
  }
  double outside = std::sqrt(outside_squared), largest = 0;
  for (unsigned int s = radii.size() - 1; s-- > 0;) {
    const double height = radii[s + 1] - radii[s];
    const auto between = [&](const ForceColumn& column) {
      const auto piece = std::find_if(column.begin(), column.end(), [&](const ForcePiece& piece) {
        return piece.end >= radii[s + 1];
      });
      return coefficients_between(*piece, radii[s], radii[s + 1]);
    };
    std::transform(others.begin(), others.end(), of_others.begin(), between);
    ForcePiece::Coefficients squares = {};
    for (unsigned int p = 0; p < columns.size(); ++p) {
      ForcePiece::Coefficients missed = between(columns[p]);
      for (unsigned int i = 0; i < others.size(); ++i)
        for (unsigned int k = 0; k < n; ++k)
          missed[k] -= from_others(p, i) * of_others[i][k];
      for (unsigned int k = 0; k < n; ++k)
        squares[k] += rule.weight(p) * missed[k] * missed[k];
    }
    ForcePiece::Coefficients missed;
    std::transform(squares.begin(), squares.end(), missed.begin(),
                   [](double x) { return std::sqrt(x); });
    // Legendre polynomials other than the first have no mean: |int_t^1 L_k| <= (t (1 - t))^(1/2).
    const double within = std::accumulate(missed.begin(), missed.end(), missed[0]) / 2;
    largest = std::max(largest, outside + height * within);
    outside += height * missed[0];
  }
  return largest;
}

} // namespace rollwave
