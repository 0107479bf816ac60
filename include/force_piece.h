#ifndef ROLLWAVE_FORCE_PIECE_H
#define ROLLWAVE_FORCE_PIECE_H

#include <array>
#include <vector>

namespace rollwave {

/// A force f_0 on a line z = const, from one radius to another.
struct ForcePiece {
  static constexpr unsigned int n_coefficients = 8;
  using Coefficients = std::array<double, n_coefficients>;

  double begin, end;         ///< radii
  Coefficients coefficients; ///< of rho f_0, by the Legendre polynomials L_k orthonormal on [0, 1]
  double outside;            ///< G(end, z)
};

/// L_k(t) for all k.
ForcePiece::Coefficients legendre_values(double t);

/// int_r^end L_k drho for all k, by int P_k = (P_(k+1) - P_(k-1)) / (2 k + 1). On the piece G(r, z)
/// = int_r^b rho f_0 drho is the product of these with the coefficients, and what is outside.
ForcePiece::Coefficients legendre_integrals(double begin, double end, double r);

/// f_0 on a line z = const, from the hub outwards.
using ForceColumn = std::vector<ForcePiece>;

/// The number of the first piece that ends at r or beyond, or of the last one. A right @p guess
/// saves the search.
unsigned int piece_at(const ForceColumn& column, double r, unsigned int guess);

} // namespace rollwave

#endif
