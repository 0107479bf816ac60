#pragma once

#include "rollwave/error_bound/error_bound.h"
#include "rollwave/run/mesh.h"
#include "rollwave/run/progress.h"
#include "rollwave/run/result.h"
#include "rollwave/run/run_options.h"
#include "rollwave/run/solve_on_mesh.h"
#include "rollwave/scene/scene.h"

#include <optional>

namespace rollwave {

/// A solved scene with its field.
struct Solution {
  Scene scene; ///< with the distance, and the shear modulus, that a given load or nip needs
  Mesh mesh;
  FieldVector displacement; ///< u_h
  std::optional<Certificate> certificate;
  Result result;

  const RingSpace& space() const { return *mesh.space; }
};

/// A run while it lasts.
struct Run {
  const RunOptions& options;
  Mesh mesh;
  RunStatistics statistics = {};
  std::vector<CycleFigures> cycles = {}; ///< one for each mesh that was solved
  bool is_repeated = false; ///< makes the best mesh once more, whose solution was not kept; is not
                            ///< interrupted, since nothing would be left
};

/// Checks what needs no mesh. @throws BadValue for a mesh that is too large or has too many contact
/// nodes
void check_simulation(const Scene& scene, const RunOptions& options);

/**
 * Solves @p scene on the mesh and by the methods of @p options; with adaptive cycles: solve,
 * certify, mark, refine, beginning each contact iteration with the pressure of the mesh before.
 * The shortfalls among Result::notes say which targets were not reached. Towards a wanted error the
 * run ends after 40 meshes without a finite bound, or 8 without a smaller one, and the mesh with
 * the smallest bound counts.
 *
 * When the user interrupts it, the current mesh is the last one: its solution, certified where that
 * was asked for, is returned, and Result::is_interrupted is set if anything is missing.
 *
 * On several processes all call it with their @p communicator, and get the same Result; mesh and
 * field are shared among them.
 *
 * @throws BadInput as check_simulation() and for a force that cannot be used, NotSolved when memory
 *         is short or a method fails,
 *         Interrupted before the first mesh is solved.
 */
Solution simulate(const Scene& scene, const RunOptions& options,
                  MPI_Comm communicator = MPI_COMM_SELF, const Progress& progress = {});

/// Solves a scene without refinement on objects that belong to the same radii, mesh options, speed
/// and force, and whose zone contains that of the scene.
/// @param run with the work and seconds of making the objects, if they are to be part of the result
/// @throws BadValue for a load or a nip that no distance gives; NotSolved as solve_on_mesh();
/// Interrupted
Solution solve_on_shared(Run run, MeshObjects& shared, const Scene& scene);

} // namespace rollwave
