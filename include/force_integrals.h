#ifndef ROLLWAVE_FORCE_INTEGRALS_H
#define ROLLWAVE_FORCE_INTEGRALS_H

#include "force_piece.h"
#include "radial_shapes.h"

#include <vector>

namespace rollwave {

/// G = int_r^b rho f_0 drho of a ForceInterpolant at given radii, on one line z = const after
/// another.
class ForceAtRadii {
public:
  /// @param radii increasing
  explicit ForceAtRadii(std::vector<double> radii);

  void integrals(const ForceColumn& column, std::vector<double>& values);

private:
  struct Weights {
    double begin = 0, end = 0; ///< of the piece; 0 before the first
    ForcePiece::Coefficients integrals;
  };

  const std::vector<double> radii;
  std::vector<Weights> weights; ///< for the pieces met last
  unsigned int first_piece = 0; ///< their first one's number
};

/// int G psi_i / r dr over a radial interval, psi_i the potential's shape functions, on one line z
/// = const after another: where f_0 has one piece there, from its coefficients.
class ForceLoads {
public:
  /// @p radial stays where it is
  explicit ForceLoads(const RadialShapes& radial);

  void integrate(const ForceColumn& column, std::vector<double>& loads);

private:
  void prepare(const ForcePiece& piece);

  const RadialShapes& radial;
  ForceAtRadii at_radii;
  std::vector<double> moments; ///< G at the radii
  unsigned int recent_piece = 0;
  double begin = 0, end = 0; ///< of the piece prepared last
  std::vector<double> of_outside;
  std::vector<ForcePiece::Coefficients> of_coefficients;
};

} // namespace rollwave

#endif
