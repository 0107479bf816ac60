#pragma once

#include "rollwave/base/run_statistics.h"
#include "rollwave/solver/contact_linear_solver.h"

#include <memory>
#include <optional>
#include <string>

namespace rollwave {

struct Scene;

enum class SolverKind {
  /// "auto": the kind that suits the mesh.
  automatic,
  /// "direct": one sparse Cholesky factorisation for each mesh.
  direct,
  /// "iterative": conjugate gradients with algebraic multigrid.
  iterative
};

/// Section `Solver`.
struct SolverOptions {
  SolverKind kind = SolverKind::automatic;
};

/// A solver, its kind, and the reason if "auto" chose the iterative kind on one process; otherwise
/// the remark is empty.
struct SolverChoice {
  std::unique_ptr<ContactLinearSolver> solver;
  std::string remark;
  SolverKind kind = SolverKind::direct; ///< never automatic
};

/// The kind of solver that @p kind asks for, set up for @p scene. "auto" chooses the iterative kind
/// on several processes, if the dense matrices of the contact nodes would take too long, or if the
/// factor would need too much memory. Otherwise it chooses the direct kind. @p boundary, @p load
/// and @p statistics are as for ContactLinearSolver::set_problem().
/// @param candidates the nodes of the zones of all scenes that the solver is set up for
/// @throws NotSolved as the kinds do.
SolverChoice choose_solver(SolverKind kind, const ContactBoundary& candidates, const Scene& scene,
                           const ContactBoundary& boundary, const std::optional<FieldVector>& load,
                           RunStatistics& statistics);

} // namespace rollwave
