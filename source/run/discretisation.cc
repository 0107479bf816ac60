#include "rollwave/run/discretisation.h"

#include "rollwave/adapt/marking.h"
#include "rollwave/mesh/ring_mesh.h"
#include "rollwave/scene/scene.h"

namespace rollwave {

using namespace dealii;

StressFunction& MeshCache::dual_of(const Scene& scene, const RingSpace& space, Work& work) {
  const Work::Phase phase(work, "certificate");
  if (!dual || dual->angular_velocity() != scene.angular_velocity) {
    dual.reset(); // its memory is free before the next one needs it
    dual = std::make_unique<StressFunction>(space, scene, stiffness.kind, work);
  }
  return *dual;
}

Discretisation::Discretisation(const Scene& scene, const RunOptions& options, MPI_Comm communicator,
                               bool is_shared, Work& work)
    : is_shared(is_shared) {
  {
    const Work::Phase phase(work, "mesh");
    triangulation =
        make_ring_mesh(scene, options.mesh, most_cycles(options.mesh) > 0, communicator);
  }
  const Work::Phase phase(work, "space");
  space = std::make_unique<RingSpace>(*triangulation, scene, options.mesh.degree);
}

bool Discretisation::refine(const std::vector<double>& indicators, const Scene& scene,
                            const RunOptions& options, Work& work) {
  const auto& mesh = options.mesh;
  {
    const Work::Phase phase(work, "mesh");
    if (!refine_mesh(*triangulation, scene, indicators, mesh.marking, mesh.marked_fraction,
                     most_cells(options)))
      return false;
  }
  cache = {};
  const Work::Phase phase(work, "space");
  space.reset(); // its memory is free before the next one needs it
  space = std::make_unique<RingSpace>(*triangulation, scene, mesh.degree);
  return true;
}

double most_cells(const RunOptions& options) {
  return options.mesh.most_unknowns / (1. * options.mesh.degree * options.mesh.degree);
}

} // namespace rollwave
