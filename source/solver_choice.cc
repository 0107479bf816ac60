#include "solver_choice.h"

#include "direct_solver.h"
#include "errors.h"
#include "iterative_solver.h"

namespace rollwave {

SolverChoice make_stiffness_solver(SolverKind kind, const RingSpace& space, const Scene& scene,
                                   const std::optional<FieldVector>& load, Work& work) {
  SolverChoice choice;
  if (kind != SolverKind::iterative)
    try {
      choice.solver = std::make_unique<DirectSolver>(space, scene);
      choice.solver->turn_to(scene, load, work);
      return choice;
    } catch (const NotEnoughMemory& shortage) {
      if (kind == SolverKind::direct)
        throw;
      choice.remark = "solved iteratively: " + shortage.reason;
    }
  choice.solver = std::make_unique<IterativeSolver>(space);
  choice.solver->turn_to(scene, load, work);
  return choice;
}

} // namespace rollwave
