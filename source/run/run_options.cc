#include "rollwave/run/run_options.h"

#include "rollwave/base/errors.h"

#include <algorithm>

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
  return make_scene(options.cylinder, options.road, options.material, options.mesh.angular_cells);
}

RunOptions coarser(RunOptions options) {
  auto& mesh = options.mesh;
  for (int halving = 0; halving < 2; ++halving)
    if (mesh.global_refinements > 0)
      --mesh.global_refinements;
    else {
      mesh.radial_cells = (mesh.radial_cells + 1) / 2;
      mesh.angular_cells = std::max(3u, (mesh.angular_cells + 1) / 2);
    }
  mesh.adaptive_cycles = 0;
  mesh.wanted_relative_error = 0;
  options.certificate.error_bound = false;
  return options;
}

} // namespace rollwave
