#include "rollwave/run/run_options.h"

#include "rollwave/base/errors.h"

namespace rollwave {

namespace {

/// Refuses options that need the certificate if Certificate/Error bound is false.
void check_certificate(const RunOptions& options) {
  if (options.certificate.error_bound)
    return;
  if (options.mesh.wanted_relative_error > 0)
    throw BadValue("Mesh", "Wanted relative error",
                   "the target needs the error bound; set Certificate/Error bound = true");
}

} // namespace

Scene make_scene(const RunOptions& options) {
  check_certificate(options);
  return scaled_scene(options.cylinder, options.road, options.material, options.mesh.angular_cells);
}

} // namespace rollwave
