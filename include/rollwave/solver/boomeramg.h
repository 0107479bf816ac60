#pragma once

#include "rollwave/mesh/ring_space.h"

#include <deal.II/base/index_set.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <memory>

namespace rollwave {

/**
 * A cycle of classical algebraic multigrid, hypre's BoomerAMG (V. E. Henson, U. M. Yang, Appl.
 * Numer. Math. 41 (2002) 155-177), for a symmetric positive definite matrix: coarsening by Ruge and
 * Stueben along strong couplings only, whatever their direction, and Gauss-Seidel's method, forward
 * before the coarser level and backward after it, so that the cycle is symmetric.
 */
class BoomerAmg {
public:
  /// Only the diagonal entry counts in the rows and columns of @p pinned degrees of freedom.
  /// @throws NotSolved when the hierarchy cannot be made.
  BoomerAmg(const dealii::TrilinosWrappers::SparseMatrix& matrix, const dealii::IndexSet& pinned,
            MPI_Comm communicator);
  ~BoomerAmg();
  BoomerAmg(const BoomerAmg&) = delete;
  BoomerAmg& operator=(const BoomerAmg&) = delete;

  /// One cycle from zero: @p u approximates the solution for @p rhs.
  void vmult(FieldVector& u, const FieldVector& rhs) const;

private:
  struct Hypre;
  const std::unique_ptr<Hypre> hypre;
};

} // namespace rollwave
