#ifndef ROLLWAVE_MESH_ASSEMBLY_H
#define ROLLWAVE_MESH_ASSEMBLY_H

#include "rollwave/mesh/ring_space.h"

#include <deal.II/lac/full_matrix.h>

#include <functional>
#include <vector>

namespace rollwave {

struct Scene;

/// The integrals of products of two shape functions, or of their derivatives, over one direction of
/// a cell: n x n, n = degree + 1.
struct ShapeProducts {
  dealii::FullMatrix<double> mass;
  dealii::FullMatrix<double> stiffness;
};

/// A form on products R(r) Z(z),
///
///     P(R, R') int Z_z Z'_z dz + S(R, R') int Z Z' dz,
///
/// by its radial integrals over the interval [begin, end] of a cell, P as mass and S as stiffness.
/// @return valid until the next call
using RadialProducts = std::function<const ShapeProducts&(double begin, double end)>;

/// Takes the matrix of one cell and the numbers of its degrees of freedom, the radial index running
/// fastest.
using AddCellMatrix = std::function<void(const std::vector<dealii::types::global_dof_index>& dofs,
                                         const dealii::FullMatrix<double>& cell_matrix)>;

/// Calls @p add with the matrix of every cell of this process. Constraints are not applied.
void add_cell_matrices(const RingSpace& space, const RadialProducts& radial,
                       const AddCellMatrix& add);

/**
 * The radial integrals of the stiffness matrix
 *
 *     K_ij = int r (alpha d_z phi_i d_z phi_j + d_r phi_i d_r phi_j) dr dz,
 *     alpha = 1/r^2 - omega^2,
 *
 * exact except for round-off, by Gauss' rules with as many points as the factor 1/r needs
 * (graded_rule()).
 */
RadialProducts stiffness_products(const RingSpace& space, const Scene& scene);

} // namespace rollwave

#endif
