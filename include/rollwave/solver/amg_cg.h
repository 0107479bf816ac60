#ifndef ROLLWAVE_SOLVER_AMG_CG_H
#define ROLLWAVE_SOLVER_AMG_CG_H

#include "rollwave/base/mpi_session.h"
#include "rollwave/solver/boomeramg.h"
#include "rollwave/solver/spd_solver.h"

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <functional>
#include <optional>

namespace rollwave {

/// Conjugate gradients preconditioned by an BoomerAmg, on any number of processes.
class AmgCg : public SpdSolver {
public:
  explicit AmgCg(const RingSpace& space) : space(space) {}

  void set_matrix(const Scene& scene, const dealii::AffineConstraints<double>& constraints,
                  const RadialProducts& radial, Work& work) override;
  FieldVector solve(const FieldVector& rhs, Work& work) override;

  const dealii::TrilinosWrappers::SparseMatrix& matrix() const { return stiffness; }

  /// Calls @p visit with the column and the value of each entry of an own row.
  void visit_row(
      dealii::types::global_dof_index row,
      const std::function<void(dealii::types::global_dof_index column, double value)>& visit) const;

  /// The matrix, whose entries may be changed. The preconditioner stays that of the entries before.
  dealii::TrilinosWrappers::SparseMatrix& change_matrix() { return stiffness; }

  /// The next one is that of the matrix as it is when it is needed.
  void drop_preconditioner() { preconditioner.reset(); }

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
  const BoomerAmg& multigrid(Work& work);

  const RingSpace& space;
  MpiSession mpi;
  dealii::TrilinosWrappers::SparseMatrix stiffness;
  double threshold = 0;                    ///< of couplings that are strong for the preconditioner
  std::optional<BoomerAmg> preconditioner; ///< of the matrix, or nearly
};

} // namespace rollwave

#endif
