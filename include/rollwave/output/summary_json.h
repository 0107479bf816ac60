#pragma once

#include "rollwave/run/result.h"
#include "rollwave/run/run_options.h"
#include "rollwave/scene/scene.h"

#include <string>

namespace rollwave {

/// All result_quantities() of a run as JSON in the user's units, in full precision, with the scene,
/// the patches, and a line for each mesh.
std::string summary_json(const Scene& scene, const RunOptions& options, const Result& result);

} // namespace rollwave
