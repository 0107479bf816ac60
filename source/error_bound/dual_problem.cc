#include "rollwave/error_bound/dual_problem.h"

#include "rollwave/base/work.h"
#include "rollwave/scene/scene.h"

namespace rollwave {

using namespace dealii;

DualProblem::DualProblem(const RingSpace& space, const Scene& scene, SolverKind kind, Work& work)
    : angular_velocity(scene.angular_velocity), shapes(scene, space.dof_handler().get_fe().degree),
      potential(space, scene, kind, shapes, work), bubbles(space, shapes) {
  turn_to(space, scene);
}

void DualProblem::turn_to(const RingSpace& space, const Scene& scene) {
  if (!scene.force)
    force.reset();
  else if (!force || force_text != scene.force_text)
    force.emplace(space, scene, shapes);
  force_text = scene.force_text;
}

} // namespace rollwave
