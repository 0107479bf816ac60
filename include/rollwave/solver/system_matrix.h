#pragma once

#include "rollwave/solver/sparse_factor.h"

#include <deal.II/lac/full_matrix.h>

#include <memory>
#include <utility>
#include <vector>

namespace rollwave {

/// The sum K_p of the matrices of the cells of this process, until it is factorised.
class SystemMatrix {
public:
  /// @param contact_nodes none of them constrained
  SystemMatrix(const RingSpace& space, const dealii::AffineConstraints<double>& constraints,
               const std::vector<SurfaceNode>& contact_nodes = {});

  /// Adds the matrix of a cell of this process with these degrees of freedom; constraints are
  /// resolved.
  void add(const std::vector<dealii::types::global_dof_index>& dofs,
           const dealii::FullMatrix<double>& cell_matrix);

  /// Called once, after the last cell, by all processes.
  /// @throws NotEnoughMemory, or NotSolved where the sum is not positive definite
  std::unique_ptr<const SparseFactor> factorise(RunStatistics& statistics);

  /// The entries added so far, in the order of elimination.
  const LowerTriplets& entries() const { return triplets; }

private:
  /// Doubles the diagonal of the interface, and returns what it has added. To subtract it again
  /// costs no more digits than the elimination does.
  dealii::Vector<double> shift_diagonal();

  const RingSpace& space;
  const dealii::AffineConstraints<double>& constraints;
  EliminationOrder order;
  LowerTriplets triplets;

  /// For each degree of freedom of a cell the unknown that it is, or the combination of unknowns
  /// that its constraint names.
  std::vector<std::vector<std::pair<int, double>>> combinations;
};

} // namespace rollwave
