#ifndef ROLLWAVE_FORCE_INTERPOLANT_H
#define ROLLWAVE_FORCE_INTERPOLANT_H

#include "force_piece.h"
#include "interpolation.h"
#include "ring_space.h"

#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace rollwave {

struct Scene;

/**
 * A piecewise polynomial f_0 in place of the force f, with an integral
 *
 *     G(r, z) = int_r^b rho f_0(rho, z) drho
 *
 * that is known everywhere: on each of a number of panels, which cover the ring, rho f_0 is the
 * polynomial of degree 7 in each direction that equals rho f at Gauss' points, but for a constant
 * that gives m = rho (f - f_0) the mean zero.
 *
 * m is a function of r, one of z, and a rest, such that all means of these over r, over z, or over
 * both vanish where they are not constant. Poincare's inequality on intervals thus bounds (f - f_0,
 * w) on a panel h_r high and h_z long by |w|, |w|^2 = a(w, w), times the root of
 *
 *     h_r^2 / (pi^2 r) ||m_r||^2 + h_z^2 / (pi^2 r alpha) ||m_z||^2 + the lesser factor ||rest||^2,
 *
 * r and r alpha being the least on the panel. Friedrichs' inequality (Certificate), blind for
 * panels, takes m_z where alpha vanishes. The constant m_0, by which the mean may be off, adds (int
 * M^2 / r dr dz)^(1/2), M = int_r^b |m_0| drho. Norms and means are taken on half as many points
 * again in each direction.
 *
 * Panels are halved until each has a small share of the mesh's cells, then the worst first until
 * they leave out 1e-5 of what is negligible, as many as the mesh pays for; in the direction in
 * which f is rougher. They are not halved either where even the mean of f would leave out a
 * negligible part. There f_0 becomes that mean, and m_0 the root mean square of m, unless the
 * polynomial is ten times as good: whether the points beside a jump happen to agree shall not
 * matter.
 */
class ForceInterpolant {
public:
  /// The same on all processes of the space. The scene must have a force.
  /// @throws BadInput where f is not finite
  ForceInterpolant(const RingSpace& space, const Scene& scene);

  /// The pieces of a line beyond the radius @p begin.
  ForceColumn column(double z, double begin = 0) const;

  /// Those of the lines at the points of a rule for [begin, end].
  std::vector<ForceColumn> columns(double begin, double end,
                                   const dealii::Quadrature<1>& rule) const;

  /// Where within ]begin, end[ panels end, in order: G is smooth in between.
  std::vector<double> panel_ends(double begin, double end) const;

  /// A bound, for any radius, of the root mean square over z in [begin, end], at the points of the
  /// fine rule, of G less the polynomial that equals it at the points of the rule, from the
  /// coefficients. No panel may end in between.
  double missed_along_z(double begin, double end, const HalvedRule& rules) const;

  /// Whether f_0 is f itself.
  bool is_exact() const { return exact; }

  /// A bound of (f - f_0, w) / |w| for all w, |w|^2 = a(w, w).
  double error() const;

  /// N^(-p/2) C ||f|| / 100, N unknowns of degree p: an error of the load that is small beside the
  /// mesh's own. Not of a force that is exact.
  double negligible() const { return negligible_error; }

private:
  struct MeanSquares;

  /// What is left out of f on a panel.
  struct Missed {
    double mean = 0;                              ///< by how much that of rho f may be off
    double local_squared = 0, global_squared = 0; ///< of the rest, by Poincare and by Friedrichs
    double varying_squared() const { return local_squared + global_squared; }
  };

  struct Panel {
    dealii::Point<2> low, high;
    unsigned int first_half = 0;             ///< among the panels, the second follows; 0: is whole
    unsigned int direction = 0;              ///< in which it was halved
    dealii::FullMatrix<double> coefficients; ///< of rho f_0, in r and z
    unsigned int n_rows = 0;                 ///< of these, in z, that are more than round-off
    double norm_squared = 0;                 ///< int r f^2 dr dz
    Missed missed;                           ///< by f_0
    Missed beside_mean;                      ///< if f_0 were the mean of f
  };

  /// Halves the panels that have more than their share of the cells.
  void halve_where_fine(const Scene& scene, const RingSpace& space);

  /// The direction in which the last two coefficients of f_0 are larger, or where they are
  /// round-off, in which the panel is longer.
  static unsigned int rougher_direction(const Panel& panel);

  void halve(const Scene& scene, unsigned int panel, unsigned int direction);

  /// The numbers of the whole panels on the line z in [0, 2 pi), beyond a radius.
  std::vector<unsigned int> panels_on(double z, double begin) const;

  void collect(unsigned int panel, double z, double begin, std::vector<unsigned int>& line) const;

  /// The pieces of the line z in [0, 2 pi) on these panels.
  ForceColumn column_on(const std::vector<unsigned int>& line, double z) const;

  /// r f at a point given by shares of the panel's sides.
  static double moment(const Scene& scene, const Panel& panel, const dealii::Point<2>& share);

  static void interpolate(const Scene& scene, Panel& panel);

  /// What f_0 leaves out of f, but for its mean, which f_0 gets.
  void judge(const Scene& scene, Panel& panel) const;

  Missed weigh(const Scene& scene, const Panel& panel, const MeanSquares& squares,
               double mean) const;

  /// The square of the bound as if nothing were left out elsewhere.
  double squared_alone(const Panel& panel, const Missed& missed) const;

  /// f_0 becomes the mean of f.
  static void flatten(Panel& panel);

  /// C ||f||, a bound of (f, w) / |w|.
  double friedrichs_norm() const;

  const bool exact;
  const double friedrichs_squared; ///< C^2 of ||w|| <= C |w|
  double negligible_error = 0;
  std::vector<Panel> panels; ///< the ring first, halves after their whole
};

} // namespace rollwave

#endif
