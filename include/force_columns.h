#ifndef ROLLWAVE_FORCE_COLUMNS_H
#define ROLLWAVE_FORCE_COLUMNS_H

#include "force_interpolant.h"
#include "interval_map.h"

#include <deal.II/base/quadrature.h>

#include <array>
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
  /// The integrals of Legendre's polynomials of a piece from a radius to the piece's end.
  struct Weights {
    double begin = 0, end = 0; ///< of the piece; 0 before the first
    std::array<double, ForcePiece::n_coefficients> integrals;
  };

  static void prepare(Weights& at, double r, const ForcePiece& piece);

  const std::vector<double> radii;
  std::vector<Weights> weights; ///< for the pieces met last
};

/// The lines z = const and the radii at which the cells of a mesh need a force, many of which they
/// have in common: each is made when first asked for.
class ForceColumns {
public:
  /// @param rule for a cell's angular interval [0, 1]: the lines are at its points
  ForceColumns(const ForceInterpolant& force, const dealii::Quadrature<1>& rule)
      : force(force), rule(rule) {}

  /// Those of the angular interval [begin, end].
  const std::vector<ForceColumn>& on(double begin, double end);

  /// Any other.
  ForceColumn at(double z) const { return force.column(z); }

  /// For @p radii that belong to the radial interval [begin, end].
  ForceAtRadii& at_radii(double begin, double end, const std::vector<double>& radii);

private:
  const ForceInterpolant& force;
  const dealii::Quadrature<1> rule;
  IntervalMap<std::vector<ForceColumn>> columns;
  IntervalMap<ForceAtRadii> known_radii;
};

} // namespace rollwave

#endif
