#ifndef ROLLWAVE_MULTIGRID_SOLVER_H
#define ROLLWAVE_MULTIGRID_SOLVER_H

#include "mpi_session.h"
#include "symmetric_solver.h"

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <functional>
#include <optional>

namespace rollwave {

/// Conjugate gradients preconditioned by algebraic multigrid (Trilinos' ML), on any number of
/// processes.
class MultigridSolver : public SymmetricSolver {
public:
  explicit MultigridSolver(const RingSpace& space) : space(space) {}

  void set_matrix(const dealii::AffineConstraints<double>& constraints, const EachCellMatrix& each,
                  Work& work) override;
  FieldVector solve(const FieldVector& rhs, Work& work) override;

  const dealii::TrilinosWrappers::SparseMatrix& matrix() const { return stiffness; }

  /// The matrix, whose entries may be changed; the preconditioner is made anew when it is needed.
  dealii::TrilinosWrappers::SparseMatrix& change_matrix();

  /// What residuals are compared with, which may depend on the solution.
  using Scale = std::function<double(const FieldVector& u)>;

  /// Lowers |rhs - matrix u|_2 / scale(u) to @p accuracy, or to round-off where that is higher;
  /// returns what is reached.
  /// @throws NotSolved when the iteration does not come that far.
  double improve(FieldVector& u, const FieldVector& rhs, const Scale& scale, double accuracy,
                 Work& work);

private:
  double relative_residual(const FieldVector& u, const FieldVector& rhs, const Scale& scale) const;
  void iterate(FieldVector& u, const FieldVector& rhs, const Scale& scale, double accuracy,
               Work& work);
  const dealii::TrilinosWrappers::PreconditionAMG& multigrid(Work& work);

  const RingSpace& space;
  MpiSession mpi;
  dealii::TrilinosWrappers::SparseMatrix stiffness;
  std::optional<dealii::TrilinosWrappers::PreconditionAMG> preconditioner; ///< of the matrix
};

} // namespace rollwave

#endif
