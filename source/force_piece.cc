#include "force_piece.h"

#include <algorithm>
#include <cmath>

namespace rollwave {

namespace {

constexpr unsigned int n_coefficients = ForcePiece::n_coefficients;

/// Factors of Legendre's polynomials P_k: P_(k+1) = steps[k] x P_k - (steps[k] - 1) P_(k-1), and
/// norms[k]^2 int_0^1 P_k(2 t - 1)^2 dt = 1.
struct Factors {
  Factors() {
    for (unsigned int k = 0; k < n_coefficients; ++k) {
      steps[k] = (2 * k + 1.) / (k + 1);
      norms[k] = std::sqrt(2 * k + 1.);
    }
  }

  std::array<double, n_coefficients> steps, norms;
};
const Factors factors;

/// P_k(2 t - 1)
std::array<double, n_coefficients + 1> classical_legendre(double t) {
  const double x = 2 * t - 1;
  std::array<double, n_coefficients + 1> values = {{1, x}};
  for (unsigned int k = 1; k < n_coefficients; ++k)
    values[k + 1] = factors.steps[k] * x * values[k] - (factors.steps[k] - 1) * values[k - 1];
  return values;
}

} // namespace

ForcePiece::Coefficients legendre_values(double t) {
  const auto classical = classical_legendre(t);
  ForcePiece::Coefficients values;
  for (unsigned int k = 0; k < n_coefficients; ++k)
    values[k] = factors.norms[k] * classical[k];
  return values;
}

ForcePiece::Coefficients legendre_integrals(double begin, double end, double r) {
  const double length = end - begin;
  const auto classical = classical_legendre((r - begin) / length);
  ForcePiece::Coefficients integrals;
  integrals[0] = end - r;
  for (unsigned int k = 1; k < n_coefficients; ++k)
    integrals[k] = length * (classical[k - 1] - classical[k + 1]) / (2 * factors.norms[k]);
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
