#include "rollwave/run/mesh.h"

#include "rollwave/adapt/marking.h"
#include "rollwave/base/run_statistics.h"
#include "rollwave/mesh/ring_mesh.h"
#include "rollwave/scene/scene.h"

namespace rollwave {

using namespace dealii;

namespace {

std::unique_ptr<const RingSpace> make_space(const Triangulation<2>& triangulation,
                                            const Scene& scene, const RunOptions& options,
                                            RunStatistics& statistics) {
  const RunStatistics::Phase phase(statistics, "space");
  return std::make_unique<RingSpace>(triangulation, scene, options.mesh.degree);
}

} // namespace

Mesh make_mesh(const Scene& scene, const RunOptions& options, MPI_Comm communicator,
               RunStatistics& statistics) {
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
