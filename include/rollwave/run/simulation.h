#ifndef ROLLWAVE_RUN_SIMULATION_H
#define ROLLWAVE_RUN_SIMULATION_H

#include "rollwave/error_bound/error_bound.h"
#include "rollwave/mesh/ring_space.h"
#include "rollwave/run/result.h"
#include "rollwave/run/run_options.h"
#include "rollwave/run/solve_on_mesh.h"
#include "rollwave/scene/scene.h"

#include <memory>
#include <optional>

namespace rollwave {

/// A solved scene with its field; the members are listed in the order of their dependence.
struct Solution {
  Scene scene; ///< with the distance that a given load needs
  std::unique_ptr<dealii::Triangulation<2>> triangulation;
  std::unique_ptr<RingSpace> space;
  MeshCache system;         ///< empty where no scene is to follow
  FieldVector displacement; ///< u_h
  std::optional<Certificate> certificate;
  Result result;
};

/// Checks what needs no mesh to be seen. @throws BadInput for a mesh that is too large, or a kind
/// of solver that does not work on @p n_processes.
void check_simulation(const RunOptions& options, unsigned int n_processes);

/**
 * Solves @p scene on the mesh and by the methods of @p options; with adaptive cycles: solve,
 * certify, mark, refine, beginning each contact iteration with the pressure of the mesh before.
 * What was wanted and could not be reached is told in Result::shortfalls.
 *
 * When the user interrupts it, the mesh at hand is the last one: its solution, certified where that
 * was asked for, is the best there is, and Result::is_interrupted is set if anything is missing.
 *
 * On several processes all call it with their @p communicator, and get the same Result; mesh and
 * field are shared among them.
 *
 * @param previous the solution of another scene on the same mesh, or an empty one to begin with,
 *        where several scenes with the same mesh options, radii and zone are solved one after
 *        another: what depends on the mesh alone is not computed again, and what depends on mesh
 *        and speed only if the speed differs
 * @throws BadInput for a mesh or force that cannot be used, NotSolved when a solver fails,
 *         Interrupted before the first mesh is solved.
 */
Solution simulate(const Scene& scene, const RunOptions& options,
                  MPI_Comm communicator = MPI_COMM_SELF,
                  std::optional<Solution> previous = std::nullopt);

} // namespace rollwave

#endif
