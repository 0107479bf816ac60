#include "certificate_parts.h"

#include "memory.h"
#include "mesh_system.h"
#include "scene.h"
#include "task_beside.h"
#include "work.h"

#include <memory>
#include <string>
#include <vector>

namespace rollwave {

using namespace dealii;

namespace {

/// The name of the scene's force among those of a system.
std::string force_of(const Scene& scene, const MeshSystem& system) {
  return scene.force ? system.force : "";
}

bool has_potential(const MeshSystem& system, const Scene& scene) {
  return system.potential && system.potential->belongs_to(scene);
}

void make_potential(const RingSpace& space, const Scene& scene, SolverKind kind,
                    const AffineConstraints<double>& constraints, MeshSystem& system, Work& work) {
  if (!system.potential)
    system.potential = std::make_unique<DualPotential>(space, kind);
  RadialShapesOfMesh shapes(scene, space.dof_handler().get_fe().degree, system.breaks);
  system.bubbles.reset();
  system.potential->turn_to(scene, shapes, constraints, work);
  if (space.n_unknowns() < many_unknowns) // else when more memory is free
    system.bubbles.emplace(space, shapes);
}

bool has_force(const MeshSystem& system, const Scene& scene) {
  return system.dual && system.dual->belong_to(scene, force_of(scene, system));
}

void make_force(const RingSpace& space, const Scene& scene,
                const AffineConstraints<double>& constraints, MeshSystem& system) {
  system.dual = std::make_unique<DualParts>(space, scene, force_of(scene, system), system.moments,
                                            system.breaks, constraints);
}

} // namespace

bool is_certificate_prepared(const Scene& scene, const MeshSystem& system) {
  return has_potential(system, scene) && has_force(system, scene);
}

void prepare_certificate(const RingSpace& space, const Scene& scene, SolverKind kind,
                         MeshSystem& system, Work& work) {
  if (is_certificate_prepared(scene, system))
    return;
  const std::vector<EdgePressure> no_pressures(space.surface_faces().size());
  const AffineConstraints<double> constraints =
      potential_constraints(space, scene, no_pressures, ForceJumps());
  const bool is_missing = !has_potential(system, scene);
  const bool in_thread = is_missing && scene.has_uneven_force() && !has_force(system, scene) &&
                         kind != SolverKind::iterative && gains_by_threads();
  TaskBeside potential(in_thread, [&] {
    if (is_missing)
      make_potential(space, scene, kind, constraints, system, work);
  });
  if (!has_force(system, scene))
    make_force(space, scene, constraints, system);
  potential.finish();
}

} // namespace rollwave
