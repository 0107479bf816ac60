#ifndef ROLLWAVE_RUN_SOLVE_ON_MESH_H
#define ROLLWAVE_RUN_SOLVE_ON_MESH_H

#include "rollwave/contact/contact_problem.h"
#include "rollwave/error_bound/force_integral.h"
#include "rollwave/error_bound/stress_function.h"
#include "rollwave/run/result.h"
#include "rollwave/run/run_options.h"
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

/// The discrete problem and its solution on one mesh.
struct MeshSolution {
  Scene scene; ///< with the distance that a given load needs
  ContactProblem problem;
  ContactSolution contact;
  Loads stiffness;
  std::optional<std::string> shortfall; ///< of a load that is given
  FieldVector displacement;             ///< u_h
  Energy energy;                        ///< of u_h
  Residuals residuals;
};

/// Solves @p scene on @p space by the methods of @p options, beginning with the contact
/// pressures @p start (none when it has no entries). @p system is that of the same space.
/// @throws BadInput where the force is not finite, NotSolved when a solver fails or a number is
/// beyond what numbers can hold.
MeshSolution solve_on_mesh(const Scene& scene, const RunOptions& options, const RingSpace& space,
                           const dealii::Vector<double>& start, MeshCache& system, Work& work);

/// Fills in what @p result tells of a solution on one mesh, and adds to its cycles.
void measure(const RingSpace& space, const MeshSolution& solution, Result& result);

} // namespace rollwave

#endif
