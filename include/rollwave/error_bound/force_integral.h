#ifndef ROLLWAVE_ERROR_BOUND_FORCE_INTEGRAL_H
#define ROLLWAVE_ERROR_BOUND_FORCE_INTEGRAL_H

#include "rollwave/error_bound/radial_shapes.h"
#include "rollwave/mesh/ring_space.h"

#include <deal.II/base/quadrature_lib.h>

#include <cstddef>
#include <vector>

namespace rollwave {

struct Scene;

/// The rule along z by which the error bound integrates over a cell: Gauss' rule with degree + 1
/// points or, for a force that is an expression, with two more, since G_h is of a higher degree.
dealii::QGauss<1> angular_rule(const Scene& scene, unsigned int degree);

/**
 * The integral of a force f from the surface inwards,
 *
 *     G(r, z) = int_r^b rho f(rho, z) drho,      (f, w) = int G w_r dr dz   for w = 0 on r = a,
 *
 * in place of which the error bound takes a G_h. For a force that is a number, G_h = G = f (b^2 -
 * r^2)/2. For an expression G_h is, on each cell, the polynomial that equals G at the points of
 * angular_rule() along z and of RadialShapes along r; G there is a sum of Gauss' rules over the
 * radii of the whole mesh, on each line z = const of its own.
 *
 * G_h changes the work of the force on w by int (G - G_h) w_r dr dz, and that is at most delta |w|,
 *
 *     delta = (int (G - G_h)^2 / r dr dz)^(1/2),      |w|^2 = a(w, w).
 *
 * delta is judged by what the points have seen: by the highest coefficients of G_h in both
 * directions and by a second G on the two ends of the angular interval of each cell, whose rules
 * along r include the ends of the intervals; its difference from G_h and the highest modes of f on
 * its way are added. A jump of f along z in a cell makes delta about h^(1/2); on a line of the mesh
 * it costs nothing.
 */
class ForceIntegral {
public:
  /// @param shapes those of the mesh of @p space
  /// @throws BadInput where f is not finite, on all processes of the space
  ForceIntegral(const RingSpace& space, const Scene& scene, RadialShapesOfMesh& shapes);

  /// angular_rule() of the scene.
  const dealii::QGauss<1>& rule() const { return angular; }

  /// G_h of an own cell on the line number @p p of angular_rule(), at the radii of its
  /// RadialShapes.
  const double* on_line(unsigned int cell, unsigned int p) const {
    return &values[first[cell] + (is_number ? 0 : p * n_radii[cell])];
  }

  /// The same at the share @p t of the cell's angular interval.
  void on_line_at(unsigned int cell, double t, std::vector<double>& line) const;

  /// delta, of the cells of all processes; 0 for a number.
  double error() const { return delta; }

  /// The share of an active cell in delta^2.
  double cell_error_squared(unsigned int cell) const {
    return is_number ? 0 : errors_squared[cell];
  }

private:
  void integrate_number(const RingSpace& space, const Scene& scene, RadialShapesOfMesh& shapes);
  void integrate_expression(const RingSpace& space, const Scene& scene, RadialShapesOfMesh& shapes);

  const bool is_number;
  const dealii::QGauss<1> angular;
  const std::vector<dealii::Polynomials::Polynomial<double>> lagrange; ///< of its points
  std::vector<double> values;        ///< of a cell: all radii on the first line, then on the next
  std::vector<std::size_t> first;    ///< of each active cell, among the values
  std::vector<unsigned int> n_radii; ///< likewise
  std::vector<double> errors_squared;
  double delta = 0;
};

} // namespace rollwave

#endif
