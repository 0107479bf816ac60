#include "force_columns.h"

#include <deal.II/base/polynomial.h>

#include <cmath>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

constexpr unsigned int n = ForcePiece::n_coefficients;

} // namespace

ForceAtRadii::ForceAtRadii(std::vector<double> radii)
    : radii(std::move(radii)), weights(this->radii.size()) {}

void ForceAtRadii::integrals(const ForceColumn& column, std::vector<double>& values) {
  values.resize(radii.size());
  auto piece = column.begin();
  for (unsigned int q = 0; q < radii.size(); ++q) {
    while (radii[q] > piece->end && piece + 1 != column.end())
      ++piece;
    Weights& at = weights[q];
    if (at.begin != piece->begin || at.end != piece->end)
      prepare(at, radii[q], *piece);
    double even = piece->outside, odd = 0;
    for (unsigned int k = 0; k < n; k += 2) {
      even += piece->coefficients[k] * at.integrals[k];
      odd += piece->coefficients[k + 1] * at.integrals[k + 1];
    }
    values[q] = even + odd;
  }
}

void ForceAtRadii::prepare(Weights& at, double r, const ForcePiece& piece) {
  static const auto legendre = Polynomials::Legendre::generate_complete_basis(n);
  at.begin = piece.begin;
  at.end = piece.end;
  const double length = piece.end - piece.begin, t = (r - piece.begin) / length;
  std::array<double, n + 1> scaled; // L_k / (2 k + 1)^(1/2)
  for (unsigned int k = 0; k <= n; ++k)
    scaled[k] = legendre[k].value(t) / std::sqrt(2 * k + 1.);
  // int_t^1 L_k = (L_(k-1)/(2 k - 1)^(1/2) - L_(k+1)/(2 k + 3)^(1/2)) / (2 (2 k + 1)^(1/2))
  at.integrals[0] = piece.end - r;
  for (unsigned int k = 1; k < n; ++k)
    at.integrals[k] = length * (scaled[k - 1] - scaled[k + 1]) / (2 * std::sqrt(2 * k + 1.));
}

const std::vector<ForceColumn>& ForceColumns::on(double begin, double end) {
  if (force.is_exact()) // a number, the same on all lines
    begin = end = 0;
  return columns.at(begin, end, [&] {
    std::vector<ForceColumn> lines;
    for (const auto& point : rule.get_points())
      lines.push_back(force.column(begin + (end - begin) * point[0]));
    return lines;
  });
}

ForceAtRadii& ForceColumns::at_radii(double begin, double end, const std::vector<double>& radii) {
  return known_radii.at(begin, end, [&] { return ForceAtRadii(radii); });
}

} // namespace rollwave
