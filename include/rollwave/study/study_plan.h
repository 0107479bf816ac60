#ifndef ROLLWAVE_STUDY_STUDY_PLAN_H
#define ROLLWAVE_STUDY_STUDY_PLAN_H

#include "rollwave/parameters/parameters.h"

#include <string>
#include <tuple>
#include <vector>

namespace rollwave {

/// What one run of a study is to do: all that is set, and of that what varies within the scene.
struct RunPlan {
  std::string scene;
  std::vector<Setting> varied;
  Parameters parameters; ///< without a study
};

/// The runs of a study in their order. @throws BadInput when a setting of one is refused.
std::vector<RunPlan> plan_runs(const Parameters& parameters);

/// Runs that have this in common can share a mesh.
inline auto mesh_key(const Parameters& parameters) {
  const auto& mesh = parameters.mesh;
  return std::tuple(parameters.cylinder.inner_radius, parameters.cylinder.outer_radius,
                    parameters.road.contact_zone, mesh.degree, mesh.radial_cells,
                    mesh.angular_cells, mesh.global_refinements, mesh.adaptive_cycles,
                    mesh.wanted_relative_error, mesh.indicator, mesh.marking, mesh.marked_fraction,
                    mesh.most_unknowns, parameters.solver.kind);
}

/// What mesh_key() returns.
using MeshKey = decltype(mesh_key(Parameters()));

} // namespace rollwave

#endif
