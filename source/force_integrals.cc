#include "force_integrals.h"

#include <utility>

namespace rollwave {

ForceAtRadii::ForceAtRadii(std::vector<double> radii)
    : radii(std::move(radii)), weights(this->radii.size()) {}

void ForceAtRadii::integrals(const ForceColumn& column, std::vector<double>& values) {
  values.resize(radii.size());
  first_piece = piece_at(column, radii.front(), first_piece);
  auto piece = column.begin() + first_piece;
  for (unsigned int q = 0; q < radii.size(); ++q) {
    while (radii[q] > piece->end && piece + 1 != column.end())
      ++piece;
    Weights& at = weights[q];
    if (at.begin != piece->begin || at.end != piece->end)
      at = {piece->begin, piece->end, legendre_integrals(piece->begin, piece->end, radii[q])};
    double even = piece->outside, odd = 0;
    for (unsigned int k = 0; k < ForcePiece::n_coefficients; k += 2) {
      even += piece->coefficients[k] * at.integrals[k];
      odd += piece->coefficients[k + 1] * at.integrals[k + 1];
    }
    values[q] = even + odd;
  }
}

ForceLoads::ForceLoads(const RadialShapes& radial)
    : radial(radial), at_radii(radial.r), of_outside(radial.shapes.size() / radial.r.size()),
      of_coefficients(of_outside.size()) {}

void ForceLoads::integrate(const ForceColumn& column, std::vector<double>& loads) {
  recent_piece = piece_at(column, radial.r.front(), recent_piece);
  const ForcePiece& piece = column[recent_piece];
  if (radial.r.back() > piece.end) {
    at_radii.integrals(column, moments);
    radial.integrate_over_r(moments, loads);
    return;
  }
  if (begin != piece.begin || end != piece.end)
    prepare(piece);
  for (unsigned int i = 0; i < loads.size(); ++i) {
    double even = piece.outside * of_outside[i], odd = 0;
    for (unsigned int k = 0; k < ForcePiece::n_coefficients; k += 2) {
      even += piece.coefficients[k] * of_coefficients[i][k];
      odd += piece.coefficients[k + 1] * of_coefficients[i][k + 1];
    }
    loads[i] = even + odd;
  }
}

void ForceLoads::prepare(const ForcePiece& piece) {
  begin = piece.begin;
  end = piece.end;
  const unsigned int n_q = radial.r.size(), n = of_outside.size();
  moments.assign(n_q, 1.);
  radial.integrate_over_r(moments, of_outside);
  std::vector<ForcePiece::Coefficients> integrals;
  for (const double r : radial.r)
    integrals.push_back(legendre_integrals(begin, end, r));
  std::vector<double> loads(n);
  for (unsigned int k = 0; k < ForcePiece::n_coefficients; ++k) {
    for (unsigned int q = 0; q < n_q; ++q)
      moments[q] = integrals[q][k];
    radial.integrate_over_r(moments, loads);
    for (unsigned int i = 0; i < n; ++i)
      of_coefficients[i][k] = loads[i];
  }
}

} // namespace rollwave
