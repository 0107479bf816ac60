#include "force_piece.h"

#include <deal.II/base/polynomial.h>

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

ForcePiece::Coefficients legendre_integrals(double begin, double end, double r) {
  constexpr unsigned int n = ForcePiece::n_coefficients;
  static const auto legendre = Polynomials::Legendre::generate_complete_basis(n);
  const double length = end - begin, t = (r - begin) / length;
  std::array<double, n + 1> scaled; // L_k / (2 k + 1)^(1/2)
  for (unsigned int k = 0; k <= n; ++k)
    scaled[k] = legendre[k].value(t) / std::sqrt(2 * k + 1.);
  // int_t^1 L_k = (L_(k-1)/(2 k - 1)^(1/2) - L_(k+1)/(2 k + 3)^(1/2)) / (2 (2 k + 1)^(1/2))
  ForcePiece::Coefficients integrals;
  integrals[0] = end - r;
  for (unsigned int k = 1; k < n; ++k)
    integrals[k] = length * (scaled[k - 1] - scaled[k + 1]) / (2 * std::sqrt(2 * k + 1.));
  return integrals;
}

unsigned int piece_at(const ForceColumn& column, double r, unsigned int guess) {
  const auto ends_before = [r](const ForcePiece& piece) { return piece.end < r; };
  const unsigned int last = column.size() - 1;
  if (guess <= last && (guess == 0 || ends_before(column[guess - 1])) &&
      (guess == last || !ends_before(column[guess])))
    return guess;
  return std::partition_point(column.begin(), column.begin() + last, ends_before) - column.begin();
}

} // namespace rollwave
