#ifndef ROLLWAVE_RUN_MESH_CACHE_H
#define ROLLWAVE_RUN_MESH_CACHE_H

#include "rollwave/error_bound/force_integral.h"
#include "rollwave/error_bound/stress_function.h"
#include "rollwave/solver/choose_solver.h"

#include <memory>
#include <optional>
#include <string>

namespace rollwave {

/// What scenes on one mesh share. Each part is made when it is first needed and turned to another
/// scene at the cost of what differs.
struct MeshCache {
  SolverChoice stiffness; ///< its kind outlives the solver
  std::unique_ptr<StressFunction> dual;
  std::unique_ptr<ForceIntegral> force; ///< nullptr without force
  std::optional<FieldVector> load;      ///< of the same
  std::string force_text;               ///< of the scene that force and load belong to

  /// Makes the dual problem that of a scene. @throws as StressFunction
  StressFunction& dual_of(const Scene& scene, const RingSpace& space, Work& work);
};

} // namespace rollwave

#endif
