#pragma once

#include "rollwave/mesh/ring_space.h"
#include "rollwave/run/run_options.h"

#include <deal.II/grid/tria.h>

#include <memory>
#include <vector>

namespace rollwave {

class RunStatistics;

/// A mesh and its space. They depend on the radii, the mesh options, and the zone of contact if
/// that is given.
struct Mesh {
  std::unique_ptr<dealii::Triangulation<2>> triangulation;
  std::unique_ptr<const RingSpace> space;

  MPI_Comm communicator() const { return space->communicator(); }
};

/// About how many nodes of the first mesh lie in the zone of contact.
double count_contact_nodes(const Scene& scene, const MeshOptions& mesh);

/// The first mesh of @p options. @throws BadValue as make_ring_mesh(); NotEnoughMemory also where
/// there is not enough for the whole run
Mesh make_mesh(const Scene& scene, const RunOptions& options, MPI_Comm communicator,
               RunStatistics& statistics);

/// Refines a mesh by refine_mesh(), and makes its space anew. Returns false, and changes nothing,
/// where refine_mesh() does. All processes must call it.
bool refine(Mesh& mesh, const std::vector<double>& indicators, double goal, const Scene& scene,
            const RunOptions& options, RunStatistics& statistics);

/// The most cells that MeshOptions::most_unknowns allows.
double most_cells(const RunOptions& options);

} // namespace rollwave
