#pragma once

#include "rollwave/solver/contact_linear_solver.h"
#include "rollwave/solver/sparse_cholesky.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <optional>
#include <vector>

namespace rollwave {

/**
 * The direct kind: one sparse Cholesky factorisation of K with the contact nodes (the candidates)
 * last. The problem on the contact nodes is then dense and small,
 *
 *     S u_c = g - N_c,   S = L_cc L_cc^T,   g = f_c - K_ci K_ii^-1 f_i = L_cc (L^-1 f)_c,
 *
 * so that pinning any of them never touches the large matrix again, and one back-substitution
 * L_ii^T u_i = (L^-1 f)_i - L_ci^T u_c gives the field.
 */
class DirectSolver : public ContactLinearSolver {
public:
  /// @param candidates the nodes of all zones that set_problem() will get
  explicit DirectSolver(const ContactBoundary& candidates)
      : space(candidates.space()), candidates(candidates), boundary(candidates),
        cholesky(space, candidates.contact_nodes()) {}

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
  void factorise(const Scene& scene);
  bool solve_dense(const std::vector<bool>& pinned, const dealii::Vector<double>& contact_load,
                   dealii::Vector<double>& displacement, dealii::Vector<double>& force) const;
  void divide_by_schur(dealii::Vector<double>& force) const;

  /// From values on contact nodes to values on candidates, zero elsewhere, and back.
  template <typename Values>
  Values on_candidates(const Values& contact_values) const;
  dealii::Vector<double> on_contact(const dealii::Vector<double>& values) const;

  /// The place of the first contact node among the candidates.
  unsigned int first_contact() const {
    return boundary.first_surface_node() - candidates.first_surface_node();
  }

  const RingSpace& space;
  const ContactBoundary candidates;
  ContactBoundary boundary; ///< of the scene
  RunStatistics* statistics = nullptr;
  std::optional<double> angular_velocity; ///< of the scene that is factorised
  SparseCholesky cholesky;
  dealii::LAPACKFullMatrix<double> factor; ///< L_cc
  dealii::LAPACKFullMatrix<double> schur;  ///< S
  std::optional<FieldVector> load;         ///< f; nullopt for f = 0
  bool is_reduced = false;                 ///< true if reduced_load and contact_load are up to date
  std::vector<double> reduced_load;        ///< L^-1 f; empty for f = 0
  dealii::Vector<double> contact_load;     ///< g
};

} // namespace rollwave
