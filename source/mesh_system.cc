#include "mesh_system.h"

namespace rollwave {

DualParts::DualParts(const RingSpace& space, const Scene& scene, const std::string& force,
                     const std::vector<double>& moments, const LoadBreaks& breaks,
                     const dealii::AffineConstraints<double>& constraints)
    : angular_velocity(scene.angular_velocity), force(force),
      shapes(scene, space.dof_handler().get_fe().degree, breaks),
      extents(scene.has_uneven_force() ? RadialExtents(space) : RadialExtents()),
      interpolant(scene.force ? std::optional<ForceInterpolant>(std::in_place, space, scene,
                                                                moments, extents)
                              : std::nullopt),
      gauss(space.dof_handler().get_fe().degree + (has_uneven_force() ? 2 : 1)) {
  if (has_uneven_force())
    jumps = ForceJumps(*interpolant, scene, extents);
  if (interpolant)
    columns.emplace(scene, *interpolant, gauss, extents, jumps);
  if (has_uneven_force())
    of_force.emplace(space, constraints, shapes, *columns, jumps);
}

bool DualParts::belong_to(const Scene& scene, const std::string& of_scene) const {
  return angular_velocity == scene.angular_velocity && force == of_scene;
}

} // namespace rollwave
