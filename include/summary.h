#ifndef ROLLWAVE_SUMMARY_H
#define ROLLWAVE_SUMMARY_H

#include "result.h"
#include "scene.h"

#include <string>

namespace rollwave {

/// All numbers of a run as JSON, in full precision: scene, mesh, contact, energy, residuals,
/// iterations, work, seconds and peak_memory_mib.
std::string summary_json(const Scene& scene, const Parameters& parameters, const Result& result);

} // namespace rollwave

#endif
