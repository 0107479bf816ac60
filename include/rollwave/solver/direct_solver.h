#ifndef ROLLWAVE_SOLVER_DIRECT_SOLVER_H
#define ROLLWAVE_SOLVER_DIRECT_SOLVER_H

#include "rollwave/solver/contact_linear_solver.h"
#include "rollwave/solver/dense_schur.h"
#include "rollwave/solver/sparse_cholesky.h"

#include <map>
#include <memory>
#include <optional>

namespace rollwave {

/**
 * The direct kind: one sparse Cholesky factorisation of K with the contact nodes (the candidates)
 * last. The problem on the contact nodes is then dense and small,
 *
 *     S u_c = g - N_c,   S = L_cc L_cc^T,   g = f_c - K_ci K_ii^-1 f_i = L_cc (L^-1 f)_c,
 *
 * so that pinning any of them never touches the large matrix again, and one back-substitution
 * L_ii^T u_i = (L^-1 f)_i - L_ci^T u_c gives the field. The contact nodes that are the likeliest to
 * be pinned, where the road is nearest, are the very last, as DenseSchur likes them.
 */
class DirectSolver : public ContactLinearSolver {
public:
  /// For scenes whose roads are nearest at one place.
  explicit DirectSolver(const RingSpace& space) : space(space) {}

  void turn_to(const Scene& scene, const std::optional<FieldVector>& load, Work& work) override;
  double solve(const std::vector<bool>& pinned, ContactState& state, double accuracy) override;
  dealii::Vector<double> response(const dealii::Vector<double>& force, double accuracy) override;
  FieldVector displacement_field(const ContactState& state) override;
  FieldVector apply(const FieldVector& field) const override;

private:
  void number_unknowns(const Scene& scene);
  void factorise(const Scene& scene);
  dealii::Vector<double> to_places(const dealii::Vector<double>& contact_values) const;
  dealii::Vector<double> from_places(const dealii::Vector<double>& values) const;

  const RingSpace& space;
  Work* work = nullptr;
  /// The places of the candidates among the last unknowns, and of the contact nodes among them.
  std::map<dealii::types::global_dof_index, unsigned int> place_of_dof;
  std::vector<unsigned int> places;
  std::optional<double> angular_velocity; ///< of the scene that is factorised
  std::unique_ptr<SparseCholesky> cholesky;
  std::unique_ptr<DenseSchur> schur;
  std::optional<FieldVector> load;     ///< f; nullopt for f = 0
  bool is_reduced = false;             ///< whether what follows belongs to it and to the factor
  std::vector<double> reduced_load;    ///< L^-1 f; empty for f = 0
  dealii::Vector<double> contact_load; ///< g, by place
};

} // namespace rollwave

#endif
