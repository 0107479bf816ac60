#include "rollwave/run/mesh.h"

#include "rollwave/adapt/marking.h"
#include "rollwave/base/memory.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/run_statistics.h"
#include "rollwave/base/text.h"
#include "rollwave/mesh/ring_mesh.h"
#include "rollwave/scene/scene.h"
#include "rollwave/solver/condensed_system.h"

#include <deal.II/base/numbers.h>

#include <cmath>
#include <string>

namespace rollwave {

using namespace dealii;

namespace {

std::unique_ptr<const RingSpace> make_space(const Triangulation<2>& triangulation,
                                            const Scene& scene, const RunOptions& options,
                                            RunStatistics& statistics) {
  const RunStatistics::Phase phase(statistics, "space");
  return std::make_unique<RingSpace>(triangulation, scene, options.mesh.degree);
}

/// Asks for what a whole run on the first mesh takes at least, before any of it is made.
void require_memory_of_run(const Scene& scene, const MeshOptions& mesh, MPI_Comm communicator) {
  // Peaks of figure 4 with its certificate, from 1e5 unknowns on: 1150 to 1550 bytes an unknown of
  // degree 1 to 4, and 2200 of degree 8. The factor's part grows like their logarithm.
  constexpr double bytes_per_unknown = 1000;
  const double unknowns = count_unknowns(mesh), nodes = count_contact_nodes(scene, mesh);
  require_dense_memory(nodes / count_processes(communicator), communicator);
  require_memory(bytes_per_unknown * unknowns / count_processes(communicator),
                 "a run with " + rounded(unknowns, 15) + " unknowns", communicator);
}

} // namespace

double count_contact_nodes(const Scene& scene, const MeshOptions& mesh) {
  const double share = (scene.zone_end - scene.zone_begin) / (2 * numbers::PI);
  return share * std::ldexp(1. * mesh.degree * mesh.angular_cells, mesh.global_refinements);
}

Mesh make_mesh(const Scene& scene, const RunOptions& options, MPI_Comm communicator,
               RunStatistics& statistics) {
  require_memory_of_run(scene, with_enough_cells(scene, options.mesh), communicator);
  Mesh mesh;
  {
    const RunStatistics::Phase phase(statistics, "mesh");
    mesh.triangulation = make_ring_mesh(scene, options.mesh, communicator);
  }
  mesh.space = make_space(*mesh.triangulation, scene, options, statistics);
  return mesh;
}

bool refine(Mesh& mesh, const std::vector<double>& indicators, double goal, const Scene& scene,
            const RunOptions& options, RunStatistics& statistics) {
  {
    const RunStatistics::Phase phase(statistics, "mesh");
    if (!refine_mesh(*mesh.triangulation, scene, indicators, goal, options.mesh,
                     most_cells(options)))
      return false;
  }
  mesh.space.reset(); // frees its memory first
  mesh.space = make_space(*mesh.triangulation, scene, options, statistics);
  return true;
}

double most_cells(const RunOptions& options) {
  return options.mesh.most_unknowns / (1. * options.mesh.degree * options.mesh.degree);
}

} // namespace rollwave
