#include "rollwave/solver/choose_solver.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/solver/direct_solver.h"
#include "rollwave/solver/iterative_solver.h"

#include <deal.II/base/exceptions.h>

#include <new>

namespace rollwave {

using namespace dealii;

namespace {

/// @throws NotEnoughMemory, also in place of std::bad_alloc and deal.II's ExcOutOfMemory
std::unique_ptr<ContactLinearSolver>
make_direct(const ContactBoundary& candidates, const Scene& scene, const ContactBoundary& boundary,
            const std::optional<FieldVector>& load, RunStatistics& statistics) {
  try {
    auto solver = std::make_unique<DirectSolver>(candidates);
    solver->set_problem(scene, boundary, load, statistics);
    return solver;
  } catch (const std::bad_alloc&) {
  } catch (const ExcOutOfMemory&) { // by the vectors of deal.II
  }
  throw NotEnoughMemory("the direct kind needs more memory than there is");
}

/// True if the dense factorisations for m contact nodes, m^3 operations each, take longer than
/// conjugate gradients on all unknowns.
bool is_dense_part_slow(const ContactBoundary& candidates) {
  constexpr double most_operations = 2e6; // for each unknown, measured
  const double m = candidates.size();
  return m * m * m > most_operations * candidates.space().n_unknowns();
}

} // namespace

SolverChoice choose_solver(SolverKind kind, const ContactBoundary& candidates, const Scene& scene,
                           const ContactBoundary& boundary, const std::optional<FieldVector>& load,
                           RunStatistics& statistics) {
  SolverChoice choice;
  if (!is_serial(candidates.space().communicator())) {
    AssertThrow(kind != SolverKind::direct, ExcInternalError());
    kind = SolverKind::iterative;
  }
  if (kind == SolverKind::automatic && is_dense_part_slow(candidates)) {
    kind = SolverKind::iterative;
    choice.remark = "solved iteratively: the dense factorisations of " +
                    std::to_string(candidates.size()) + " contact nodes would take longer";
  }
  if (kind != SolverKind::iterative)
    try {
      choice.solver = make_direct(candidates, scene, boundary, load, statistics);
      return choice;
    } catch (const NotEnoughMemory& shortage) {
      if (kind == SolverKind::direct)
        throw;
      choice.remark = "solved iteratively: " + shortage.reason;
    }
  choice.kind = SolverKind::iterative;
  choice.solver = std::make_unique<IterativeSolver>(candidates);
  choice.solver->set_problem(scene, boundary, load, statistics);
  return choice;
}

} // namespace rollwave
