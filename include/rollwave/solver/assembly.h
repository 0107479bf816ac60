#pragma once

#include "rollwave/mesh/ring_space.h"

#include <deal.II/lac/full_matrix.h>

#include <functional>
#include <vector>

namespace rollwave {

struct Scene;

/// Takes the matrix of a cell with these degrees of freedom.
using AddCellMatrix = std::function<void(const std::vector<dealii::types::global_dof_index>& dofs,
                                         const dealii::FullMatrix<double>& cell_matrix)>;

/**
 * Gives the matrices of the cells of this process, whose sum over all is the stiffness matrix
 *
 *     K_ij = a(phi_j, phi_i) = int r (alpha d_z phi_j d_z phi_i + d_r phi_j d_r phi_i) dr dz,
 *     alpha = 1/r^2 - omega^2,
 *
 * by Gauss' rules: exact along z, the factor 1/r to 1e-13.
 */
void assemble_stiffness(const RingSpace& space, const Scene& scene, const AddCellMatrix& add);

} // namespace rollwave
