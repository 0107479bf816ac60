#ifndef ROLLWAVE_MATRIX_PATTERN_H
#define ROLLWAVE_MATRIX_PATTERN_H

#include <memory>

namespace dealii {
class IndexSet;
template <typename number>
class AffineConstraints;
template <int dim, int spacedim>
class DoFHandler;
namespace TrilinosWrappers {
class SparsityPattern;
}
} // namespace dealii

namespace rollwave {

/**
 * The pairs of degrees of freedom that meet in a cell, when those that the @p constraints tie to
 * others stand for these. Each process has the rows of its own; @p relevant are those of its cells
 * and of the cells next to them.
 */
std::unique_ptr<dealii::TrilinosWrappers::SparsityPattern>
make_matrix_pattern(const dealii::DoFHandler<2, 2>& handler,
                    const dealii::AffineConstraints<double>& constraints,
                    const dealii::IndexSet& relevant);

} // namespace rollwave

#endif
