#include "rollwave/run/discretisation.h"

#include "rollwave/adapt/marking.h"
#include "rollwave/mesh/ring_mesh.h"
#include "rollwave/scene/scene.h"

namespace rollwave {

using namespace dealii;

StressFunction& MeshCache::stress_function_for(const Scene& scene, const RingSpace& space,
                                               RunStatistics& statistics) {
  const RunStatistics::Phase phase(statistics, "certificate");
  if (!stress_function || stress_function->angular_velocity() != scene.angular_velocity) {
    stress_function.reset(); // frees its memory first
    stress_function = std::make_unique<StressFunction>(space, scene, stiffness.kind, statistics);
  }
  return *stress_function;
}

namespace {

std::unique_ptr<Triangulation<2>> make_first_mesh(const Scene& scene, const RunOptions& options,
                                                  MPI_Comm communicator,
                                                  RunStatistics& statistics) {
  const RunStatistics::Phase phase(statistics, "mesh");
  return make_ring_mesh(scene, options.mesh, most_cycles(options.mesh) > 0, communicator);
}

std::unique_ptr<RingSpace> make_space(const Triangulation<2>& triangulation, const Scene& scene,
                                      const RunOptions& options, RunStatistics& statistics) {
  const RunStatistics::Phase phase(statistics, "space");
  return std::make_unique<RingSpace>(triangulation, scene, options.mesh.degree);
}

} // namespace

Discretisation::Discretisation(const Scene& scene, const RunOptions& options, MPI_Comm communicator,
                               RunStatistics& statistics,
                               const std::optional<std::pair<double, double>>& shared_zone)
    : triangulation(make_first_mesh(scene, options, communicator, statistics)),
      space(make_space(*triangulation, scene, options, statistics)),
      is_shared(shared_zone.has_value()), widest_zone(shared_zone.value_or(scene.zone())),
      candidates(*space, widest_zone) {}

bool Discretisation::refine(const std::vector<double>& indicators, const Scene& scene,
                            const RunOptions& options, RunStatistics& statistics) {
  const auto& mesh = options.mesh;
  {
    const RunStatistics::Phase phase(statistics, "mesh");
    if (!refine_mesh(*triangulation, scene, indicators, mesh, most_cells(options)))
      return false;
  }
  cache = {};
  space.reset(); // frees its memory first
  space = make_space(*triangulation, scene, options, statistics);
  candidates = ContactBoundary(*space, widest_zone);
  return true;
}

double most_cells(const RunOptions& options) {
  return options.mesh.most_unknowns / (1. * options.mesh.degree * options.mesh.degree);
}

} // namespace rollwave
