#ifndef ROLLWAVE_ASSEMBLY_H
#define ROLLWAVE_ASSEMBLY_H

#include "load_breaks.h"
#include "ring_space.h"

#include <deal.II/lac/full_matrix.h>

#include <functional>
#include <vector>

namespace rollwave {

struct Scene;

/// Takes the stiffness matrix of one cell and the numbers of its degrees of freedom.
using AddCellMatrix = std::function<void(const std::vector<dealii::types::global_dof_index>& dofs,
                                         const dealii::FullMatrix<double>& cell_matrix)>;

/**
 * Calls @p add for every cell of this process with
 *
 *     K_ij = int r (alpha d_z phi_i d_z phi_j + d_r phi_i d_r phi_j) dr dz,
 *     alpha = 1/r^2 - omega^2,
 *
 * exact but for round-off, by Gauss' rules with degree + 1 points in z and as many in r as the
 * factor 1/r needs (graded_rule()), the radial index of the degrees of freedom running fastest.
 * Constraints are not applied.
 */
void assemble_stiffness(const RingSpace& space, const Scene& scene, const AddCellMatrix& add);

/// What a force does to a mesh.
struct Load {
  FieldVector vector; ///< f_i = int r f phi_i dr dz with the constraints applied

  /// r f at the points of the rule for whole cells on one own active cell after another, the radial
  /// index running fastest; none when the force is a number
  std::vector<double> moments;

  LoadBreaks breaks; ///< none when the force is a number
};

/**
 * The load by Gauss' rule with degree + 1 points in each direction, on each of the parts into which
 * LoadBreaks cut a cell; the scene must have a force.
 *
 * @throws BadInput where f is not finite.
 */
Load assemble_load(const RingSpace& space, const Scene& scene);

} // namespace rollwave

#endif
