#ifndef ROLLWAVE_OUTPUT_SCREEN_REPORT_H
#define ROLLWAVE_OUTPUT_SCREEN_REPORT_H

#include "rollwave/exact/exact_solution.h"
#include "rollwave/output/output_directory.h"
#include "rollwave/run/result.h"
#include "rollwave/scene/scene.h"
#include "rollwave/scene/units.h"

#include <iosfwd>

namespace rollwave {

/// Says what will be solved.
void report_scene(std::ostream& out, const Scene& scene, const Parameters& parameters);

/// Tells what a run has found: mesh, a line for each contact step, results and residuals.
/// @param result in the user's units, which @p units name
void report_result(std::ostream& out, const Result& result, const Units& units);

/// Prints our numbers beside the exact ones, with their differences, in the user's units.
/// @param result in those of the scene
void report_verification(std::ostream& out, const Scene& scene, const Result& result,
                         const ExactSolution& exact);

/// Tells where the time went and which files were written.
void report_end(std::ostream& out, const Work& work, const WrittenFiles& written);

/// Lists the written files.
void report_files(std::ostream& out, const WrittenFiles& written);

} // namespace rollwave

#endif
