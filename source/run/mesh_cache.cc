#include "rollwave/run/mesh_cache.h"

#include "rollwave/base/work.h"
#include "rollwave/scene/scene.h"

namespace rollwave {

StressFunction& MeshCache::dual_of(const Scene& scene, const RingSpace& space, Work& work) {
  const Work::Phase phase(work, "certificate");
  if (!dual || dual->angular_velocity() != scene.angular_velocity) {
    dual.reset(); // its memory is free before the next one needs it
    dual = std::make_unique<StressFunction>(space, scene, stiffness.kind, work);
  }
  return *dual;
}

} // namespace rollwave
