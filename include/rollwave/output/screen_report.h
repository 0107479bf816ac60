#pragma once

#include "rollwave/output/output_directory.h"
#include "rollwave/run/result.h"
#include "rollwave/scene/scene.h"
#include "rollwave/scene/units.h"

#include <iosfwd>

namespace rollwave {

/// Says what will be solved.
void report_scene(std::ostream& out, const Scene& scene, const Parameters& parameters);

/// Prints the mesh, a line for each contact step, the results in the user's units, and residuals.
void report_result(std::ostream& out, const Result& result, const Units& units);

/// Prints the seconds of each phase and the written files.
void report_end(std::ostream& out, const RunStatistics& statistics, const WrittenFiles& written);

/// Lists the written files.
void report_files(std::ostream& out, const WrittenFiles& written);

} // namespace rollwave
