#ifndef ROLLWAVE_RUN_MESH_CACHE_H
#define ROLLWAVE_RUN_MESH_CACHE_H

#include "rollwave/error_bound/dual_problem.h"
#include "rollwave/solver/choose_solver.h"

#include <memory>
#include <optional>
#include <string>

namespace rollwave {

/// What scenes on one mesh share. Each part is made when it is first needed and turned to another
/// scene at the cost of what differs.
struct MeshCache {
  SolverChoice stiffness; ///< its kind outlives the solver
  std::unique_ptr<DualProblem> dual;
  std::optional<FieldVector> load; ///< of assemble_load(), nullopt without force
  std::string force_text;          ///< of the scene that the load belongs to

  /// Makes the dual problem that of a scene. @throws as DualProblem
  DualProblem& dual_of(const Scene& scene, const RingSpace& space, Work& work);
};

} // namespace rollwave

#endif
