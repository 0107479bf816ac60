#pragma once

#include "rollwave/mesh/ring_space.h"

#include <deal.II/base/index_set.h>

#include <vector>

namespace rollwave {

/// The unknowns that a process keeps and does not eliminate, in their order.
struct KeptUnknowns {
  /// So many come first: contact nodes on which no cells of other processes depend. The others are
  /// the interface, unknowns on which cells of several processes depend: none on one process.
  unsigned int n_inner = 0;

  std::vector<int> contact_nodes; ///< of each its number among all contact nodes, -1 without
  std::vector<dealii::types::global_dof_index> rows; ///< of the interface its numbers, ascending
  dealii::IndexSet own_rows; ///< of all numbers those that belong to this process

  unsigned int size() const { return contact_nodes.size(); }

  /// True if a value that several processes have is counted on this one.
  bool is_own(unsigned int kept) const {
    return kept < n_inner || own_rows.is_element(rows[kept - n_inner]);
  }
};

/// The unknowns of the cells of one process in their order of elimination. Those that it keeps come
/// last.
struct EliminationOrder {
  /// All processes must call it.
  /// @param contact_nodes none of them constrained
  EliminationOrder(const RingSpace& space, const dealii::AffineConstraints<double>& constraints,
                   const std::vector<SurfaceNode>& contact_nodes);

  int n_unknowns = 0;
  std::vector<int> unknown_of_dof; ///< by RingSpace::local_index(); -1 where there is none
  KeptUnknowns kept;
};

} // namespace rollwave
