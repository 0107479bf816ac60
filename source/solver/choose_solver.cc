#include "rollwave/solver/choose_solver.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/solver/direct_solver.h"
#include "rollwave/solver/iterative_solver.h"

namespace rollwave {

using namespace dealii;

SolverChoice choose_solver(SolverKind kind, const RingSpace& space, const Scene& scene,
                           const std::optional<FieldVector>& load, Work& work) {
  SolverChoice choice;
  if (!is_alone(space.communicator())) {
    AssertThrow(kind != SolverKind::direct, ExcInternalError());
    kind = SolverKind::iterative;
  }
  if (kind != SolverKind::iterative)
    try {
      choice.solver = std::make_unique<DirectSolver>(space);
      choice.solver->set_problem(scene, load, work);
      return choice;
    } catch (const NotEnoughMemory& shortage) {
      if (kind == SolverKind::direct)
        throw;
      choice.solver.reset(); // the other one needs its memory
      choice.remark = "solved iteratively: " + shortage.reason;
    }
  choice.kind = SolverKind::iterative;
  choice.solver = std::make_unique<IterativeSolver>(space);
  choice.solver->set_problem(scene, load, work);
  return choice;
}

} // namespace rollwave
