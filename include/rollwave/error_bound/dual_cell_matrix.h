#pragma once

#include "rollwave/error_bound/radial_shapes.h"

#include <deal.II/lac/full_matrix.h>

namespace rollwave {

/**
 * The matrix of a cell for the form that the stress function psi of a flux minimises,
 *
 *     int psi_s chi_s ds dz + int psi_z chi_z / r dr dz,   ds = r alpha dr.
 *
 * On a cell, stress functions are products R(r) Z(z) of radial shapes and polynomials, so that its
 * matrix is a sum of two products of one-dimensional ones, which costs less than quadrature on the
 * cell. Degrees of freedom are numbered as by LexicographicDofs.
 */
class DualCellMatrix {
public:
  /// @param shapes must outlive it
  DualCellMatrix(const RadialShapesOfMesh& shapes, unsigned int degree);

  /// @return valid until the next call
  const dealii::FullMatrix<double>& on(const dealii::DoFHandler<2>::active_cell_iterator& cell);

private:
  const RadialShapesOfMesh& shapes;
  const ShapeProducts angular;
  dealii::FullMatrix<double> matrix;
};

} // namespace rollwave
