#include "rollwave/solver/spd_solver.h"

#include "rollwave/base/memory.h"
#include "rollwave/solver/amg_cg.h"
#include "rollwave/solver/cholmod_assembly.h"
#include "rollwave/solver/cholmod_factor.h"

#include <utility>
#include <vector>

namespace rollwave {

using namespace dealii;

namespace {

/// By a sparse Cholesky factorisation, on one process. The analysis is kept.
class CholeskySolver : public SpdSolver {
public:
  explicit CholeskySolver(const RingSpace& space) : space(space) {}

  void set_matrix(const Scene& /*scene*/, const AffineConstraints<double>& constraints,
                  const RadialProducts& radial, Work& work) override {
    const bool is_first = !cholesky; // later factors take the place of the one before
    if (is_first) {
      unknown_of_dof.assign(space.dof_handler().n_dofs(), -1);
      int n_unknowns = 0;
      for (const auto dof : space.elimination_order())
        if (!constraints.is_constrained(dof))
          unknown_of_dof[dof] = n_unknowns++;
      cholesky = std::make_unique<CholmodFactor>(n_unknowns);
    }
    {
      TripletAssembler assembler(space, constraints, unknown_of_dof);
      add_cell_matrices(space, radial,
                        [&](const auto& dofs, const FullMatrix<double>& cell_matrix) {
                          assembler.add(dofs, cell_matrix);
                        });
      if (cholesky->set_matrix(assembler.triplets))
        ++work.orderings;
    }
    if (is_first)
      require_memory(sizeof(double) * cholesky->n_factor_entries(),
                     "the factor of the dual problem");
    cholesky->factorise();
    ++work.factorisations;
  }

  FieldVector solve(const FieldVector& rhs, Work& work) override {
    std::vector<double> unknowns(cholesky->size());
    for (unsigned int dof = 0; dof < unknown_of_dof.size(); ++dof)
      if (unknown_of_dof[dof] >= 0)
        unknowns[unknown_of_dof[dof]] = rhs(dof);
    unknowns = cholesky->backward(cholesky->forward(std::move(unknowns)));
    ++work.forward_substitutions;
    ++work.back_substitutions;
    FieldVector solution = space.make_field();
    for (unsigned int dof = 0; dof < unknown_of_dof.size(); ++dof)
      if (unknown_of_dof[dof] >= 0)
        solution(dof) = unknowns[unknown_of_dof[dof]];
    return solution;
  }

private:
  const RingSpace& space;
  std::vector<int> unknown_of_dof; ///< -1 where a constraint holds
  std::unique_ptr<CholmodFactor> cholesky;
};

} // namespace

std::unique_ptr<SpdSolver> make_spd_solver(SolverKind kind, const RingSpace& space) {
  if (kind == SolverKind::iterative)
    return std::make_unique<AmgCg>(space);
  return std::make_unique<CholeskySolver>(space);
}

} // namespace rollwave
