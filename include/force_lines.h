#ifndef ROLLWAVE_FORCE_LINES_H
#define ROLLWAVE_FORCE_LINES_H

#include "force_interpolant.h"

#include <deal.II/base/quadrature_lib.h>

#include <vector>

namespace rollwave {

/**
 * Lines z = const of an angular interval [begin, end] at the points of a rule for integrals over it
 * of G = int_r^b rho f_0 drho (ForceInterpolant), and of its square, at some radii.
 *
 * That rule is the Gauss rule of the cell or, where no panel ends in the interval, one with more
 * points, which takes G for the polynomial G_h along z that equals it at the points, where a bound
 * of what it misses, G - G_h, is negligible. Else it is exact: Gauss' rules with 8 points between
 * the ends of panels, where G may jump, and with 3 on parts so short that they add nothing but
 * that.
 */
struct ForceLines {
  /// @param gauss the rule of the cell and, as far as there are any, those with more points, for
  /// intervals in which no panel ends; each with the one that is exact there
  /// @param negligible root mean square of G - G_h over z, for any of the radii
  ForceLines(const ForceInterpolant& force, double begin, double end,
             const std::vector<FinerRule>& gauss, double negligible, const RadialExtent& radii);

  /// Whether the rule is the cell's.
  bool has_rule_of_cell() const { return ends.empty(); }

  dealii::Quadrature<1> rule;       ///< on [0, 1]
  std::vector<ForceColumn> columns; ///< at its points
  std::vector<double> ends;         ///< 0, those of panels and 1, if the rule is not the cell's
  /// A bound of the mean over z of (G - G_h)^2, for any of the radii.
  double missed_mean_square = 0;
};

/// A bound, for any of some radii, of the root mean square over z, by a rule for [0, 1], of G on
/// @p columns at its points less the polynomial in z that equals G on @p others at the points of
/// another rule: from the coefficients of f_0.
double missed_along_z(const dealii::Quadrature<1>& rule, const std::vector<ForceColumn>& columns,
                      const dealii::Quadrature<1>& other, const std::vector<ForceColumn>& others,
                      const RadialExtent& radii);

} // namespace rollwave

#endif
