#include "solver_choice.h"

#include "direct_solver.h"
#include "errors.h"
#include "iterative_solver.h"

namespace rollwave {

SolverChoice make_stiffness_solver(SolverKind kind, const RingSpace& space, const Scene& scene,
                                   const std::optional<FieldVector>& load, Work& work) {
  std::string remark;
  if (kind != SolverKind::iterative)
    try {
      return {std::make_unique<DirectSolver>(space, scene, load, work), ""};
    } catch (const NotEnoughMemory& shortage) {
      if (kind == SolverKind::direct)
        throw;
      remark = "solved iteratively: " + shortage.reason;
    }
  return {std::make_unique<IterativeSolver>(space, scene, load, work), remark};
}

} // namespace rollwave
