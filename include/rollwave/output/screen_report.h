#ifndef ROLLWAVE_OUTPUT_SCREEN_REPORT_H
#define ROLLWAVE_OUTPUT_SCREEN_REPORT_H

#include "rollwave/output/output_directory.h"
#include "rollwave/run/result.h"
#include "rollwave/scene/scene.h"

#include <iosfwd>

namespace dealii {
class TableHandler;
}

namespace rollwave {

/// Says what will be solved.
void report_scene(std::ostream& out, const Scene& scene, const Parameters& parameters);

/// Tells what a run has found: mesh, a line for each contact step, results and residuals.
/// @param result in the user's units, which @p units name
void report_result(std::ostream& out, const Result& result, const Units& units);

/// Tells where the time went and which files were written.
void report_end(std::ostream& out, const Work& work, const WrittenFiles& written);

/// Prints a table for reading. Like the other texts it is lost where @p out has failed: whoever
/// waits for files shall not lose them with the screen.
void print_table(std::ostream& out, const dealii::TableHandler& table);

/// Lists the written files.
void report_files(std::ostream& out, const WrittenFiles& written);

} // namespace rollwave

#endif
