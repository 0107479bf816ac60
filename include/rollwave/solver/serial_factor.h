#pragma once

#include "rollwave/solver/cholmod_factor.h"
#include "rollwave/solver/sparse_factor.h"

#include <vector>

namespace rollwave {

/// The unknowns of a space in their order of elimination, with some nodes last.
struct EliminationOrder {
  EliminationOrder(const RingSpace& space, const dealii::AffineConstraints<double>& constraints,
                   const std::vector<SurfaceNode>& last);

  int n_unknowns = 0;
  int n_last;
  std::vector<int> unknown_of_dof; ///< -1 where a constraint holds
};

/// A SystemMatrix on one process.
class SerialMatrix : public SystemMatrix {
public:
  SerialMatrix(const RingSpace& space, const dealii::AffineConstraints<double>& constraints,
               const std::vector<SurfaceNode>& contact_nodes);

  void add(const std::vector<dealii::types::global_dof_index>& dofs,
           const dealii::FullMatrix<double>& cell_matrix) override;
  std::unique_ptr<const SparseFactor> factorise(RunStatistics& statistics) override;

  /// The entries added so far, in the order of elimination.
  const LowerTriplets& entries() const { return triplets; }

private:
  const RingSpace& space;
  const dealii::AffineConstraints<double>& constraints;
  EliminationOrder order;
  LowerTriplets triplets;

  /// For each degree of freedom of a cell the unknown that it is, or the combination of unknowns
  /// that its constraint names.
  std::vector<std::vector<std::pair<int, double>>> combinations;
};

/// A SparseFactor on one process, by CHOLMOD. The contact nodes are the last unknowns.
class SerialFactor : public SparseFactor {
public:
  SerialFactor(const RingSpace& space, EliminationOrder order, CholmodFactor cholesky);

  FieldVector solve(const FieldVector* rhs, const dealii::Vector<double>& contact_values,
                    RunStatistics& statistics) const override;
  FieldVector apply(const FieldVector& x) const override;
  dealii::FullMatrix<double> schur_factor() const override;

private:
  /// The values of a field at the unknowns, and the field with these values.
  std::vector<double> gather(const FieldVector& field) const;
  FieldVector scatter(const std::vector<double>& unknowns) const;

  const RingSpace& space;
  const EliminationOrder order;
  const CholmodFactor cholesky;
};

} // namespace rollwave
