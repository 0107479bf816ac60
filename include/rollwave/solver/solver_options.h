#ifndef ROLLWAVE_SOLVER_SOLVER_OPTIONS_H
#define ROLLWAVE_SOLVER_SOLVER_OPTIONS_H

namespace rollwave {

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

} // namespace rollwave

#endif
