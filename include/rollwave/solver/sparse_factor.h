#pragma once

#include "rollwave/solver/cholmod_factor.h"
#include "rollwave/solver/elimination_order.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace rollwave {

class RunStatistics;

/**
 * A symmetric positive definite matrix K on the unknowns of a space, factorised. The contact nodes
 * (c), none for some matrices, are parted from the other unknowns (i):
 *
 *     ( K_ii  K_ic )
 *     ( K_ci  K_cc ),     S = K_cc - K_ci K_ii^-1 K_ic.
 *
 * Fields are zero where a constraint holds. All processes must call all functions.
 *
 * K is the sum of the matrices K_p of the cells of the processes p. Each process eliminates the
 * unknowns that only its own cells have, which gives the Schur complement S_p of those that it
 * keeps: the interface and its contact nodes. The sum of all S_p, a matrix of few rows, is
 * factorised on every process. This is the method of substructures (J. S. Przemieniecki, AIAA J. 1
 * (1963) 138-147). On one process no sum is needed.
 */
class SparseFactor {
public:
  /// @param own the factor of K_p, to which @p shift is added on the diagonal of the unknowns kept
  /// @param joined the factor of the sum of all S_p, on several processes
  SparseFactor(const RingSpace& space, EliminationOrder order, CholmodFactor own,
               dealii::Vector<double> shift, std::optional<CholmodFactor> joined);

  /// The field x with given x_c and K_ii x_i = rhs_i - K_ic x_c.
  /// @param rhs null for zero
  FieldVector solve(const FieldVector* rhs, const dealii::Vector<double>& contact_values,
                    RunStatistics& statistics) const;

  /// rhs_c - K_ci K_ii^-1 rhs_i
  dealii::Vector<double> condense(const FieldVector& rhs, RunStatistics& statistics) const;

  /// K x
  FieldVector apply(const FieldVector& x) const;

  /// The lower triangular L with L L^T = S, on all processes.
  dealii::LAPACKFullMatrix<double> schur_factor() const;

private:
  /// The values of a field at the unknowns of this process whose local index is below @p n_local;
  /// zeros at the others. Of a right-hand side it takes what this process owns, so that no process
  /// adds a value a second time.
  std::vector<double> gather(const FieldVector& field, unsigned int n_local) const;

  /// The sum over the processes of what each has for the unknowns that it keeps.
  std::vector<double> join(const dealii::Vector<double>& condensed) const;

  const RingSpace& space;
  const EliminationOrder order;
  const CholmodFactor own;
  const dealii::Vector<double> shift;
  const std::optional<CholmodFactor> joined;
};

/// The sum of matrices of cells, until it is factorised.
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
  const RingSpace& space;
  const dealii::AffineConstraints<double>& constraints;
  const int n_contact_nodes;
  EliminationOrder order;
  LowerTriplets triplets;

  /// For each degree of freedom of a cell the unknown that it is, or the combination of unknowns
  /// that its constraint names.
  std::vector<std::vector<std::pair<int, double>>> combinations;
};

} // namespace rollwave
