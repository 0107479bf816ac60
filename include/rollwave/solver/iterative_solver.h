#pragma once

#include "rollwave/solver/amg_cg.h"
#include "rollwave/solver/contact_linear_solver.h"

#include <optional>
#include <vector>

namespace rollwave {

/**
 * The iterative kind: an AmgCg finds u on the nodes that are not pinned (f: free, p: pinned),
 *
 *     K_ff u_f = f_f - N_f - K_fp u_p,   then   N_p = f_p - K_pf u_f - K_pp u_p,
 *
 * started from the field of the solve before. The values at the contact nodes are summed over the
 * processes, so that all processes have the same numbers and choose the same active set.
 */
class IterativeSolver : public ContactLinearSolver {
public:
  /// @param candidates the nodes of all zones that set_problem() will get
  explicit IterativeSolver(const ContactBoundary& candidates)
      : space(candidates.space()), boundary(candidates), system(space), field(space.make_field()) {}

  /// @throws NotEnoughMemory when the matrix and its multigrid hierarchy would not fit.
  void set_problem(const Scene& scene, const ContactBoundary& boundary,
                   const std::optional<FieldVector>& load, RunStatistics& statistics) override;

  double solve(const std::vector<bool>& pinned, ContactState& state, double accuracy) override;
  dealii::Vector<double> apply_compliance(const dealii::Vector<double>& force,
                                          double accuracy) override;
  ContactState derivative(const std::vector<bool>& pinned,
                          const dealii::Vector<double>& displacement, double accuracy) override;
  FieldVector displacement_field(const ContactState& state) override;
  FieldVector apply(const FieldVector& field) const override;

private:
  /// Solves from @p u on, for the load @p f (nullptr for none).
  double solve(const std::vector<bool>& pinned, const FieldVector* f, FieldVector& u,
               ContactState& state, double accuracy);

  /// f_i - (K u)_i at the contact nodes.
  dealii::Vector<double> reactions(const FieldVector* f, const FieldVector& u) const;

  const RingSpace& space;
  ContactBoundary boundary; ///< of the scene
  const std::optional<FieldVector>* load = nullptr;
  RunStatistics* statistics = nullptr;
  std::optional<double> angular_velocity; ///< of the matrix
  AmgCg system;
  FieldVector field; ///< u of the last solve, zero where a constraint holds
};

} // namespace rollwave
