#ifndef ROLLWAVE_MESH_SYSTEM_H
#define ROLLWAVE_MESH_SYSTEM_H

#include "bubble_columns.h"
#include "dual_potential.h"
#include "force_integral.h"
#include "solver_choice.h"

#include <memory>
#include <optional>
#include <string>

namespace rollwave {

/// What the certificates of scenes on one mesh with one speed share, and of one force.
struct DualProblem {
  /// @throws BadInput where the force is not finite, NotSolved when memory is short
  DualProblem(const RingSpace& space, const Scene& scene, SolverKind kind, Work& work);

  /// Turns to a scene of the same speed. @throws BadInput where the force is not finite
  void turn_to(const RingSpace& space, const Scene& scene);

  /// nullptr where G is a function of r alone, which does no work on potentials.
  const ForceIntegral* uneven_force(const Scene& scene) const {
    return scene.has_uneven_force() ? &*force : nullptr;
  }

  double angular_velocity;
  RadialShapesOfMesh shapes;
  DualPotential potential;
  BubbleColumns bubbles;
  std::string force_text;             ///< of the scene that what follows belongs to
  std::optional<ForceIntegral> force; ///< nullopt without force
};

/// What scenes on one mesh share. Each part is made when it is first needed and turned to another
/// scene at the cost of what differs.
struct MeshSystem {
  SolverChoice stiffness; ///< its kind outlives the solver
  std::unique_ptr<DualProblem> dual;
  std::optional<FieldVector> load; ///< of assemble_load(), nullopt without force
  std::string force_text;          ///< of the scene that the load belongs to
};

} // namespace rollwave

#endif
