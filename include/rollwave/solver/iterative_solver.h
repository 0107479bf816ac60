#ifndef ROLLWAVE_SOLVER_ITERATIVE_SOLVER_H
#define ROLLWAVE_SOLVER_ITERATIVE_SOLVER_H

#include "rollwave/solver/amg_cg.h"
#include "rollwave/solver/contact_linear_solver.h"

#include <deal.II/base/index_set.h>

#include <optional>
#include <vector>

namespace rollwave {

/**
 * The iterative kind: conjugate gradients on the nodes that are not pinned (f: free, p: pinned),
 *
 *     K_ff u_f = f_f - N_f - K_fp u_p,   then   N_p = f_p - K_pf u_f - K_pp u_p,
 *
 * by a AmgCg for the same nodes, started from the field of the solve before. On many
 * processes each solve ends with one sum over all of them for the values of the contact nodes, and
 * so each contact step with the same active set.
 */
class IterativeSolver : public ContactLinearSolver {
public:
  explicit IterativeSolver(const RingSpace& space);

  /// @throws NotEnoughMemory when the matrix and its multigrid hierarchy would not fit.
  void turn_to(const Scene& scene, const std::optional<FieldVector>& load, Work& work) override;

  double solve(const std::vector<bool>& pinned, ContactState& state, double accuracy) override;
  dealii::Vector<double> response(const dealii::Vector<double>& force, double accuracy) override;
  FieldVector displacement_field(const ContactState& state) override;
  FieldVector apply(const FieldVector& field) const override;

private:
  void find_couplings();
  void pin(const std::vector<bool>& pinned);
  bool is_pinned(dealii::types::global_dof_index dof) const { return pinned_dofs.is_element(dof); }

  /// f_i - (K u)_i at the contact nodes.
  dealii::Vector<double> reactions(const FieldVector& u) const;

  const RingSpace& space;
  const std::optional<FieldVector>* load = nullptr;
  Work* work = nullptr;
  std::optional<double> angular_velocity; ///< of the matrix

  /// K, where pinned nodes are not coupled to any other: of their rows and columns the diagonal
  /// entry is left.
  AmgCg system;
  dealii::IndexSet contact_dofs;
  dealii::IndexSet pinned_dofs;
  dealii::IndexSet multigrid_dofs; ///< those that the preconditioner knows as pinned

  /// An entry of K in the row or column of a contact node.
  struct Coupling {
    dealii::types::global_dof_index row;
    dealii::types::global_dof_index column;
    double value;
  };
  std::vector<Coupling> couplings;                       ///< those of the own rows
  dealii::TrilinosWrappers::SparseMatrix contact_matrix; ///< of all couplings

  FieldVector field; ///< u of the last solve, zero where a constraint holds
};

} // namespace rollwave

#endif
