#ifndef ROLLWAVE_MESH_SOLUTION_H
#define ROLLWAVE_MESH_SOLUTION_H

#include "contact_solver.h"
#include "mesh_system.h"
#include "result.h"

namespace rollwave {

/// The discrete problem and its solution on one mesh.
struct MeshSolution {
  ContactProblem problem;
  ContactSolution contact;
  FieldVector displacement; ///< u_h
  Energy energy;            ///< of u_h
  Residuals residuals;
};

/// Solves @p scene on @p space by the methods of @p parameters, beginning with the contact
/// pressures @p start (none when it has no entries). @p system is that of the same space.
/// @throws BadInput where the force is not finite, NotSolved when a solver fails or a number is beyond
/// what numbers can hold.
MeshSolution solve_on_mesh(const Scene& scene, const Parameters& parameters, const RingSpace& space,
                           const dealii::Vector<double>& start, MeshSystem& system, Work& work);

/// Fills in what @p result tells of a solution on one mesh, and adds to its cycles.
void measure(const Scene& scene, const RingSpace& space, const MeshSolution& solution,
             Result& result);

} // namespace rollwave

#endif
