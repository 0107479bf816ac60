#ifndef ROLLWAVE_FORCE_INTERPOLANT_H
#define ROLLWAVE_FORCE_INTERPOLANT_H

#include "force_panel_choice.h"
#include "interpolation.h"
#include "radial_extents.h"

#include <vector>

namespace rollwave {

struct Scene;

/**
 * A piecewise polynomial f_0 in place of the force f, with an integral
 *
 *     G(r, z) = int_r^b rho f_0(rho, z) drho
 *
 * that is known everywhere: on each of the panels of choose_force_panels(), that of ForcePanel.
 */
class ForceInterpolant {
public:
  /// The same on all processes of the space. The scene must have a force.
  /// @param moments r f at the points of the load (Load)
  /// @param extents those of the space
  /// @throws BadInput where f is not finite
  ForceInterpolant(const RingSpace& space, const Scene& scene, const std::vector<double>& moments,
                   const RadialExtents& extents);

  /// The pieces of a line beyond the radius @p begin.
  ForceColumn column(double z, double begin = 0) const;

  /// Those of the lines at the points of a rule for [begin, end], at some radii.
  std::vector<ForceColumn> columns(double begin, double end, const dealii::Quadrature<1>& rule,
                                   const RadialExtent& radii) const;

  /// Where within ]begin, end[ panels end, in order: from the radius @p radius outwards G is smooth
  /// in between.
  std::vector<double> panel_ends(double begin, double end, double radius) const {
    return panels.ends(begin, end, radius);
  }

  /// The angles in [0, 2 pi) where f jumps on a line z = const, in order, as far as panels end
  /// there.
  std::vector<double> jumps(const Scene& scene) const { return panels.jumps(scene); }

  /// A bound, for any of some radii, of the root mean square over z in [begin, end], by the finer
  /// rule, of G less the polynomial that equals it at the points of the rule: from the
  /// coefficients. No panel may end in between.
  double missed_along_z(double begin, double end, const FinerRule& rules,
                        const RadialExtent& radii) const;

  /// Whether f_0 is f itself.
  bool is_exact() const { return exact; }

  /// A bound of (f - f_0, w) / |w| for all w, |w|^2 = a(w, w): those of the panels and, by the m_0
  /// by which the means of rho (f - f_0) may be off, (int M^2 / r dr dz)^(1/2), M = int_r^b |m_0|
  /// drho.
  double error() const;

  /// An error of the load that is small beside the mesh's own, negligible_error_of_force(); 0 when
  /// f_0 is exact.
  double negligible() const { return negligible_error; }

private:
  const bool exact;
  const ForcePanels panels;
  const double negligible_error;
};

} // namespace rollwave

#endif
