#pragma once

#include "rollwave/base/mpi_processes.h"
#include "rollwave/solver/boomeramg.h"
#include "rollwave/solver/spd_solver.h"

#include <deal.II/base/index_set.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <functional>
#include <optional>

namespace rollwave {

/**
 * Conjugate gradients preconditioned by a BoomerAmg, on any number of processes. The values of
 * degrees of freedom that are pinned (p) are given, those of the others (f) found:
 *
 *     K_ff u_f = rhs_f - K_fp u_p.
 */
class AmgCg : public SpdSolver {
public:
  explicit AmgCg(const RingSpace& space) : space(space), pinned(space.dof_handler().n_dofs()) {}

  void set_matrix(const dealii::AffineConstraints<double>& constraints,
                  const CellMatrices& matrices, RunStatistics& statistics) override;
  FieldVector solve(const FieldVector& rhs, RunStatistics& statistics) override;

  const dealii::TrilinosWrappers::SparseMatrix& matrix() const { return stiffness; }

  /// The degrees of freedom that are pinned from here on; every process knows all of them.
  void pin(const dealii::IndexSet& dofs);

  /// The scale of residuals, which may depend on the solution.
  using Scale = std::function<double(const FieldVector& u)>;

  /// Lowers |rhs - K u|_2 / scale(u), without the pinned rows, to @p accuracy, or to round-off
  /// where that is higher; returns what is reached.
  /// @throws NotSolved when the iteration does not come that far.
  double improve(FieldVector& u, const FieldVector& rhs, const Scale& scale, double accuracy,
                 RunStatistics& statistics);

private:
  double residual_norm(const FieldVector& u, const FieldVector& rhs) const;
  void iterate(FieldVector& u, const FieldVector& rhs, double wanted, RunStatistics& statistics);
  const BoomerAmg& multigrid(RunStatistics& statistics);

  const RingSpace& space;
  MpiSession mpi;
  dealii::TrilinosWrappers::SparseMatrix stiffness;
  dealii::IndexSet pinned;
  std::optional<BoomerAmg> preconditioner; ///< of the matrix with these rows pinned
};

} // namespace rollwave
