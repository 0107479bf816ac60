#ifndef ROLLWAVE_MESH_MATRIX_PATTERN_H
#define ROLLWAVE_MESH_MATRIX_PATTERN_H

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include <memory>

namespace dealii::TrilinosWrappers {
class SparsityPattern;
}

namespace rollwave {

/**
 * The pairs of degrees of freedom that meet in a cell, when those that the @p constraints tie to
 * others stand for these. Each process has the rows of its own; @p relevant are those of its cells
 * and of the cells next to them.
 */
std::unique_ptr<dealii::TrilinosWrappers::SparsityPattern>
make_matrix_pattern(const dealii::DoFHandler<2>& handler,
                    const dealii::AffineConstraints<double>& constraints,
                    const dealii::IndexSet& relevant);

} // namespace rollwave

#endif
