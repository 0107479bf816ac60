#ifndef ROLLWAVE_MESH_LEXICOGRAPHIC_DOFS_H
#define ROLLWAVE_MESH_LEXICOGRAPHIC_DOFS_H

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>

#include <vector>

namespace rollwave {

/// The degrees of freedom of a cell with elements of degree p by their places: that of node (i, j)
/// in (r, z) has the number i + (p + 1) j.
class LexicographicDofs {
public:
  explicit LexicographicDofs(const dealii::DoFHandler<2>& handler)
      : numbering(dynamic_cast<const dealii::FE_Q<2>&>(handler.get_fe())
                      .get_poly_space_numbering_inverse()),
        hierarchic(numbering.size()), lexicographic(numbering.size()) {}

  /// @return valid until the next call
  const std::vector<dealii::types::global_dof_index>&
  of(const dealii::DoFHandler<2>::active_cell_iterator& cell) {
    cell->get_dof_indices(hierarchic);
    for (std::size_t i = 0; i < numbering.size(); ++i)
      lexicographic[i] = hierarchic[numbering[i]];
    return lexicographic;
  }

private:
  const std::vector<unsigned int> numbering;
  std::vector<dealii::types::global_dof_index> hierarchic, lexicographic;
};

} // namespace rollwave

#endif
