#ifndef ROLLWAVE_MESH_SYSTEM_H
#define ROLLWAVE_MESH_SYSTEM_H

#include "dual_potential.h"
#include "solver_choice.h"

#include <memory>
#include <optional>
#include <string>

namespace rollwave {

/// What scenes on one mesh share. Each part is made when it is first needed and turned to another
/// scene at the cost of what differs; a part that is dropped is made again.
struct MeshSystem {
  SolverChoice stiffness; ///< its kind, which outlives the solver, is also the potential's
  std::unique_ptr<DualPotential> potential;
  std::optional<FieldVector> load; ///< of assemble_load(), nullopt without force
  std::string force;               ///< the text of the force that the load belongs to
  bool is_kept = true; ///< whether another scene may come; else solvers go when they have solved
};

} // namespace rollwave

#endif
