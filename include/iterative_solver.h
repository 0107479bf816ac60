#ifndef ROLLWAVE_ITERATIVE_SOLVER_H
#define ROLLWAVE_ITERATIVE_SOLVER_H

#include "mpi_session.h"
#include "stiffness_solver.h"
#include "work.h"

#include <deal.II/base/index_set.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace rollwave {

/**
 * The iterative kind: conjugate gradients on the nodes that are not pinned (f: free, p: pinned),
 *
 *     K_ff u_f = f_f - N_f - K_fp u_p,   then   N_p = f_p - K_pf u_f - K_pp u_p,
 *
 * preconditioned by algebraic multigrid (Trilinos' ML) for the same nodes, and started from the
 * field of the solve before.
 */
class IterativeSolver : public StiffnessSolver {
public:
  explicit IterativeSolver(const RingSpace& space);

  /// @throws NotEnoughMemory when the matrix and its multigrid hierarchy would not fit.
  void turn_to(const Scene& scene, const std::optional<FieldVector>& load, Work& work) override;

  double solve(const std::vector<bool>& pinned, ContactState& state, double accuracy) override;
  dealii::Vector<double> response(const dealii::Vector<double>& force, double accuracy) override;
  FieldVector displacement_field(const ContactState& state) override;
  FieldVector apply(const FieldVector& field) const override;

private:
  void assemble(const Scene& scene);
  void pin(const std::vector<bool>& pinned);
  bool is_pinned(dealii::types::global_dof_index dof) const { return pinned_dofs.is_element(dof); }

  /// f_i - (K u)_i at a contact node.
  double reaction(unsigned int node, const FieldVector& u) const;

  /// The force that residuals are compared with: max(|f|_2, |N|_2) of a field.
  using Scale = std::function<double(const FieldVector& u)>;

  /// |rhs - matrix u|_2 / scale(u)
  double relative_residual(const FieldVector& u, const FieldVector& rhs, const Scale& scale) const;

  /// Lowers the relative residual of @p u to @p accuracy, or to round-off; returns what is reached.
  double improve(FieldVector& u, const FieldVector& rhs, const Scale& scale, double accuracy);
  void conjugate_gradients(FieldVector& u, const FieldVector& rhs, const Scale& scale,
                           double accuracy);
  const dealii::TrilinosWrappers::PreconditionAMG& multigrid();

  const RingSpace& space;
  const std::optional<FieldVector>* load = nullptr;
  Work* work = nullptr;
  std::optional<double> angular_velocity; ///< of the matrix
  MpiSession mpi;

  /// K, where pinned nodes are not coupled to any other: of their rows and columns the diagonal
  /// entry is left.
  dealii::TrilinosWrappers::SparseMatrix matrix;
  dealii::IndexSet pinned_dofs;

  /// The rows of K that belong to the contact nodes, in full.
  std::vector<std::vector<std::pair<dealii::types::global_dof_index, double>>> contact_rows;

  double threshold = 0; ///< of strong couplings, for the multigrid
  std::optional<dealii::TrilinosWrappers::PreconditionAMG> preconditioner; ///< of the matrix
  FieldVector field; ///< u of the last solve, zero where a constraint holds
};

} // namespace rollwave

#endif
