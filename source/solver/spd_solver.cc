#include "rollwave/solver/spd_solver.h"

#include "rollwave/solver/amg_cg.h"
#include "rollwave/solver/sparse_cholesky.h"

namespace rollwave {

std::unique_ptr<SpdSolver> make_spd_solver(SolverKind kind, const RingSpace& space) {
  if (kind == SolverKind::iterative)
    return std::make_unique<AmgCg>(space);
  return std::make_unique<SparseCholesky>(space);
}

} // namespace rollwave
