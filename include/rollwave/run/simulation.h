#pragma once

#include "rollwave/error_bound/error_bound.h"
#include "rollwave/run/discretisation.h"
#include "rollwave/run/progress.h"
#include "rollwave/run/result.h"
#include "rollwave/run/run_options.h"
#include "rollwave/scene/scene.h"

#include <optional>

namespace rollwave {

/// A solved scene with its field.
struct Solution {
  Scene scene; ///< with the distance that a given load needs
  Discretisation mesh;
  FieldVector displacement; ///< u_h
  std::optional<Certificate> certificate;
  Result result;

  const RingSpace& space() const { return *mesh.space; }
};

/// Checks the options that need no mesh. @throws BadInput for a mesh that is too large, or a kind
/// of solver that does not work on @p n_processes.
void check_simulation(const RunOptions& options, unsigned int n_processes);

/**
 * Solves @p scene on the mesh and by the methods of @p options; with adaptive cycles: solve,
 * certify, mark, refine, beginning each contact iteration with the pressure of the mesh before.
 * Result::shortfalls says which targets were not reached.
 *
 * When the user interrupts it, the current mesh is the last one: its solution, certified where that
 * was asked for, is returned, and Result::is_interrupted is set if anything is missing.
 *
 * On several processes all call it with their @p communicator, and get the same Result; mesh and
 * field are shared among them.
 *
 * @throws BadInput for a mesh or force that cannot be used, NotSolved when a solver fails,
 *         Interrupted before the first mesh is solved.
 */
Solution simulate(const Scene& scene, const RunOptions& options,
                  MPI_Comm communicator = MPI_COMM_SELF, const Progress& progress = {});

/// The same on a given mesh, which other scenes with the same mesh options and radii may have used.
/// Only data that depend on speed, force or zone are computed again, if these differ.
/// @param statistics work and seconds of making the mesh, if they are to be part of the result
Solution simulate(Discretisation mesh, const Scene& scene, const RunOptions& options,
                  RunStatistics statistics = RunStatistics(), const Progress& progress = {});

} // namespace rollwave
