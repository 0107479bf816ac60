#pragma once

#include "rollwave/mesh/ring_space.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <memory>
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
 * Fields are zero where a constraint holds.
 */
class SparseFactor {
public:
  virtual ~SparseFactor() = default;

  /// The field x with given x_c and K_ii x_i = rhs_i - K_ic x_c. All processes must call it.
  /// @param rhs null for zero
  virtual FieldVector solve(const FieldVector* rhs, const dealii::Vector<double>& contact_values,
                            RunStatistics& statistics) const = 0;

  /// K x, for a matrix with contact nodes: others are not kept. All processes must call it.
  virtual FieldVector apply(const FieldVector& x) const = 0;

  /// The lower triangular L with L L^T = S, on all processes.
  virtual dealii::FullMatrix<double> schur_factor() const = 0;
};

/// The sum of matrices of cells, until it is factorised.
class SystemMatrix {
public:
  virtual ~SystemMatrix() = default;

  /// Adds the matrix of a cell of this process with these degrees of freedom; constraints are
  /// resolved.
  virtual void add(const std::vector<dealii::types::global_dof_index>& dofs,
                   const dealii::FullMatrix<double>& cell_matrix) = 0;

  /// Called once, after the last cell, by all processes.
  /// @throws NotEnoughMemory, or NotSolved where the sum is not positive definite
  virtual std::unique_ptr<const SparseFactor> factorise(RunStatistics& statistics) = 0;
};

/// A zero matrix for a SerialFactor on one process, for a DistributedFactor on several.
/// @param contact_nodes none of them constrained
std::unique_ptr<SystemMatrix>
make_system_matrix(const RingSpace& space, const dealii::AffineConstraints<double>& constraints,
                   const std::vector<SurfaceNode>& contact_nodes = {});

} // namespace rollwave
