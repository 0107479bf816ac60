#pragma once

#include "rollwave/mesh/ring_space.h"

#include <vector>

namespace rollwave {

/**
 * The unknowns of the cells of one process in their order of elimination. Those that it keeps, and
 * does not eliminate, come last:
 *
 *  - the interface, unknowns on which cells of several processes depend: none on one process,
 *  - the contact nodes.
 */
struct EliminationOrder {
  /// All processes must call it.
  /// @param contact_nodes none of them constrained
  EliminationOrder(const RingSpace& space, const dealii::AffineConstraints<double>& constraints,
                   const std::vector<SurfaceNode>& contact_nodes);

  int n_unknowns = 0;
  std::vector<int> unknown_of_dof; ///< by RingSpace::local_index(); -1 where there is none

  /// For the last unknowns of this process their numbers among those that all processes keep, the
  /// interface first and all contact nodes after it.
  std::vector<int> kept;
  int n_kept_by_all = 0;
};

} // namespace rollwave
