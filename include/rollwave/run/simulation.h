#ifndef ROLLWAVE_RUN_SIMULATION_H
#define ROLLWAVE_RUN_SIMULATION_H

#include "rollwave/run/run_options.h"
#include "rollwave/run/solution.h"
#include "rollwave/scene/scene.h"

namespace rollwave {

/// Checks what needs no mesh to be seen. @throws BadInput for a mesh that is too large, or a kind
/// of solver that does not work on @p n_processes.
void check_simulation(const RunOptions& options, unsigned int n_processes);

/**
 * Solves @p scene on the mesh and by the methods of @p options; with adaptive cycles: solve,
 * certify where needed, indicate, mark, refine, beginning each contact iteration with the pressure
 * of the mesh before. What was wanted and could not be reached is told in Result::shortfall.
 *
 * When the user interrupts it, the mesh at hand is the last one: its solution, certified where that
 * was asked for, is the best there is, and Result::is_interrupted is set if anything is missing.
 *
 * Where some of the meshes of an adaptive run only can be solved, such as for want of memory, it is
 * solved again up to the last of these; where the certificate fails, there is none. Either is a
 * shortfall.
 *
 * On several processes all call it with their @p communicator, and get the same Result; mesh and
 * field are shared among them.
 *
 * @throws BadInput for a mesh or force that cannot be used, NotSolved when a solver fails,
 *         Interrupted before the first mesh is solved.
 */
Solution simulate(const Scene& scene, const RunOptions& options,
                  MPI_Comm communicator = MPI_COMM_SELF);

/**
 * Solves one of several scenes after another, @p previous, whose mesh options, radii and zone
 * are the same; an empty @p previous begins. The first mesh is the last one of @p previous. What
 * depends on the mesh alone is not computed again, and what depends on mesh and speed only if the
 * speed differs. With adaptive cycles the contact iteration begins with the pressure of @p
 * previous, and cells that have become too fine are coarsened.
 *
 * @throws BadInput, NotSolved as simulate().
 */
Solution simulate_next(const Scene& scene, const RunOptions& options, Solution previous,
                       MPI_Comm communicator = MPI_COMM_SELF);

} // namespace rollwave

#endif
