#ifndef ROLLWAVE_ERROR_BOUND_DUAL_PROBLEM_H
#define ROLLWAVE_ERROR_BOUND_DUAL_PROBLEM_H

#include "rollwave/error_bound/enrichment_columns.h"
#include "rollwave/error_bound/force_integral.h"
#include "rollwave/error_bound/stress_function.h"

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
  StressFunction potential;
  EnrichmentColumns bubbles;
  std::string force_text;             ///< of the scene that what follows belongs to
  std::optional<ForceIntegral> force; ///< nullopt without force
};

} // namespace rollwave

#endif
