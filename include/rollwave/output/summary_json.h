#ifndef ROLLWAVE_OUTPUT_SUMMARY_JSON_H
#define ROLLWAVE_OUTPUT_SUMMARY_JSON_H

#include "rollwave/run/result.h"
#include "rollwave/run/run_options.h"
#include "rollwave/scene/scene.h"

#include <string>

namespace rollwave {

/// All numbers of a run as JSON, in full precision: scene, mesh, contact, energy, residuals,
/// iterations, work, seconds and peak_memory_mib.
std::string summary_json(const Scene& scene, const RunOptions& options, const Result& result);

} // namespace rollwave

#endif
