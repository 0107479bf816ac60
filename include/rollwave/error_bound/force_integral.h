#pragma once

#include "rollwave/error_bound/radial_shapes.h"
#include "rollwave/mesh/ring_space.h"

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

#include <vector>

namespace rollwave {

struct Scene;

/**
 * An approximation Q_h of the integral Q of a force f from the surface inwards. The load and the
 * error bound are computed from it:
 *
 *     Q(r, z) = int_r^b rho f(rho, z) drho,      (f, w) = int Q w_r dr dz   for w = 0 on r = a.
 *
 * For a force that is a number, Q_h = Q = f (b^2 - r^2)/2. For an expression Q_h is, on each cell,
 * the polynomial that equals Q at the points of rule() along z and of RadialShapes along r; Q there
 * is a sum of Gauss' rules between the radii from the surface inwards, with degree + 1 points each:
 * fewer would let the energy err by more than the mesh does.
 *
 * Q_h changes the work of the force on w by int (Q - Q_h) w_r dr dz, and that is at most delta |w|,
 *
 *     delta = (int (Q - Q_h)^2 / r dr dz)^(1/2),      |w|^2 = a(w, w).
 *
 * delta is estimated on each cell from the highest coefficients of Q_h along r, from two finer
 * rules along r on one line, Gauss' and Lobatto's on quarters of the intervals, and from Q at the
 * ends of the cell on 32 lines. The last two are doubled, since a jump may lie anywhere between two
 * points. This also covers |r - r_0|^(-s), s < 1/2. The estimate assumes that f is
 * square-integrable. It may miss a strip narrower than the distances between these points, and a
 * spot smaller than a cell.
 */
class ForceIntegral {
public:
  /// @param shapes those of the mesh of @p space
  /// @throws BadInput where f is not finite, on all processes of the space
  ForceIntegral(const RingSpace& space, const Scene& scene, const RadialShapesOfMesh& shapes);

  /// The rule along z by which the error bound integrates over a cell, exactly: Gauss' rule with
  /// degree + 1 points or, for an expression, two more, Q_h being of a higher degree.
  const dealii::QGauss<1>& rule() const { return angular; }

  /// True if Q is a function of r alone.
  bool is_uniform() const { return uniform; }

  /// Q_h of an own cell on the line number @p p of rule(), at the radii of its RadialShapes.
  const double* on_line(unsigned int cell, unsigned int p) const {
    return &values[cell][uniform ? 0 : p * n_radii(cell)];
  }

  /// The same at the share @p t of the cell's angular interval.
  void values_on_line_at(unsigned int cell, double t, std::vector<double>& line) const;

  enum class TestSpace {
    displacements,   ///< int Q_h d_r phi_i dr dz
    stress_functions ///< int Q_h d_z psi_i / r dr dz
  };
  void add_load(const RingSpace& space, const RadialShapesOfMesh& shapes, TestSpace kind,
                const dealii::AffineConstraints<double>& constraints, FieldVector& load) const;

  /// delta, of the cells of all processes; 0 for a number.
  double error() const { return delta; }

  /// The share of an active cell in delta^2.
  double cell_error_squared(unsigned int cell) const { return uniform ? 0 : errors_squared[cell]; }

  /// The largest distance of the points that see f, a length; nullopt for a number.
  std::optional<double> scan_width() const { return uniform ? std::nullopt : std::optional(width); }

private:
  void integrate_uniform(const RingSpace& space, double f, const RadialShapesOfMesh& shapes);
  void integrate_expression(const RingSpace& space, const Scene& scene,
                            const RadialShapesOfMesh& shapes);
  void integrate_sector(const Scene& scene, const std::vector<double>& mesh_radii,
                        const std::vector<dealii::DoFHandler<2>::active_cell_iterator>& cells,
                        const RadialShapesOfMesh& shapes);
  unsigned int n_radii(unsigned int cell) const {
    return values[cell].size() / (uniform ? 1 : angular.size());
  }

  const bool uniform;
  const dealii::QGauss<1> angular;
  const dealii::QGauss<1> inwards; ///< the rule between neighbouring radii
  const std::vector<dealii::Polynomials::Polynomial<double>> lagrange; ///< of its points

  /// Q_h of each active cell at all radii on the first line, then on the next.
  std::vector<std::vector<double>> values;
  std::vector<double> errors_squared; ///< of each active cell; empty for a number
  double delta = 0, width = 0;
};

/// The load of Q_h on displacements, with the constraints of the space applied.
FieldVector assemble_load(const RingSpace& space, const ForceIntegral& force,
                          const RadialShapesOfMesh& shapes);

} // namespace rollwave
