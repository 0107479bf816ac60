#ifndef ROLLWAVE_RUN_SOLVE_ON_MESH_H
#define ROLLWAVE_RUN_SOLVE_ON_MESH_H

#include "rollwave/contact/contact_problem.h"
#include "rollwave/run/mesh_cache.h"
#include "rollwave/run/result.h"
#include "rollwave/run/run_options.h"

namespace rollwave {

/// The discrete problem and its solution on one mesh.
struct MeshSolution {
  Scene scene; ///< with the distance that a given load needs
  ContactProblem problem;
  ContactSolution contact;
  Loads stiffness;
  FieldVector displacement; ///< u_h
  Energy energy;            ///< of u_h
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
