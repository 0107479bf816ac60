#include "rollwave/run/run_options.h"

#include "rollwave/base/errors.h"

namespace rollwave {

Scene make_scene(const RunOptions& options) {
  if (options.mesh.wanted_relative_error > 0 && !options.certificate.error_bound)
    throw BadValue("Mesh", "Wanted relative error",
                   "the target needs the error bound; set Certificate/Error bound = true");
  return scaled_scene(options.cylinder, options.road, options.material, options.mesh.angular_cells);
}

} // namespace rollwave
