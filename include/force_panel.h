#ifndef ROLLWAVE_FORCE_PANEL_H
#define ROLLWAVE_FORCE_PANEL_H

#include "force_piece.h"

#include <deal.II/base/point.h>
#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace rollwave {

struct Scene;

/**
 * Part of the ring, on which a polynomial rho f_0 of degree 7 in each direction stands for rho f:
 * it equals that at Gauss' points, but for a constant that gives m = rho (f - f_0) the mean zero.
 *
 * m is a function of r, one of z, and a rest, such that all means of these over r, over z, or over
 * both vanish where they are not constant. Poincare's inequality on intervals thus bounds (f - f_0,
 * w) on a panel h_r high and h_z long by |w|, |w|^2 = a(w, w), times the root of
 *
 *     h_r^2 / (pi^2 r) ||m_r||^2 + h_z^2 / (pi^2 r alpha) ||m_z||^2 + the lesser factor ||rest||^2,
 *
 * r and r alpha being the least on the panel. Friedrichs' inequality (Certificate), blind for
 * panels, takes m_z where alpha vanishes. Norms and means are taken on half as many points again in
 * each direction, which include the panel's edges: what begins next to one is seen. By how much the
 * means of both sets of points differ the mean of m may be off, m_0; by a quarter of (||m_r||^2 +
 * ||m_z||^2 + ||rest||^2 / 16)^(1/2) at least, over the root of the area, since both may agree
 * about a jump.
 */
struct ForcePanel {
  /// On which f_0 is compared with f, in each direction.
  static constexpr unsigned int n_points = 3 * ForcePiece::n_coefficients / 2;

  /// Mean squares of the parts of m.
  struct MeanSquares {
    double of_z = 0, of_r = 0, rest = 0;
    double sum() const { return of_z + of_r + rest; }
  };

  /// What is left out of f.
  struct Missed {
    double mean = 0;                              ///< m_0, by how much that of m may be off
    double local_squared = 0, global_squared = 0; ///< of the rest, by Poincare and by Friedrichs
    double varying_squared() const { return local_squared + global_squared; }
  };

  /// f_0, not judged.
  /// @throws BadInput where f is not finite
  ForcePanel(const Scene& scene, const dealii::Point<2>& low, const dealii::Point<2>& high);

  /// Measures what f_0 leaves out of f, but for its mean, which f_0 gets.
  /// @throws BadInput where f is not finite
  void judge(const Scene& scene);

  /// The root mean square of rho f_0, over the least radius: f's size.
  double size_of_force() const { return coefficients.frobenius_norm() / low[0]; }

  double area() const { return (high[0] - low[0]) * (high[1] - low[1]); }

  /// Looks at m on the middle line in a direction as well, at these coordinates. Where its variance
  /// there is more than four times what the panel's points say, f does something between these, and
  /// m is taken for as large, its mean for as much off.
  /// @throws BadInput where f is not finite
  void look_along(const Scene& scene, unsigned int direction,
                  const std::vector<double>& coordinates);

  /// Of m, by the panel's points.
  double mean_square() const { return missed.mean * missed.mean + squares.sum(); }

  /// The direction in which the last two coefficients of f_0 and what is known of m are larger, or
  /// where they are round-off, in which the panel is longer.
  unsigned int rougher_direction() const;

  /// Whether f_0 is ten times as good as the mean of f. Whether the points beside a jump happen to
  /// agree shall not matter.
  bool is_resolved() const {
    return missed.varying_squared() <= beside_mean.varying_squared() / 100;
  }

  /// f_0 becomes the mean of f.
  void flatten();

  /// Takes m for as large as it was seen elsewhere, with this mean and this mean square, which is
  /// more than the panel's points say.
  void take_for(const Scene& scene, double mean, double mean_square);

  /// The square of the bound as if nothing were left out elsewhere.
  double squared_alone(const Scene& scene, const Missed& missed) const;

  dealii::Point<2> low, high;
  dealii::FullMatrix<double> coefficients; ///< of rho f_0, in r and z
  unsigned int n_rows = 0;                 ///< of these, in z, that are more than round-off
  double norm_squared = 0;                 ///< int r f^2 dr dz
  MeanSquares squares;                     ///< of m
  Missed missed;                           ///< by f_0
  MeanSquares squares_beside_mean;         ///< of m if f_0 were the mean of f
  Missed beside_mean;                      ///< likewise

private:
  static constexpr unsigned int n = ForcePiece::n_coefficients; ///< in each direction

  void interpolate(const Scene& scene);

  /// What is left out by f_0, and would be by the mean of f.
  void weigh(const Scene& scene, double mean);
  Missed weigh(const Scene& scene, const MeanSquares& squares, double mean) const;

  /// Where more is left out, along either direction.
  Missed weigh(const Scene& scene, const MeanSquares& squares, double mean, double more) const;
};

/// C^2 of Friedrichs' inequality ||w|| <= C |w|.
double friedrichs_squared(const Scene& scene);

} // namespace rollwave

#endif
