#pragma once

#include "rollwave/run/progress.h"
#include "rollwave/scene/scene.h"

#include <iosfwd>

namespace rollwave {

/// Prints slow phases, a contact step about every second, and a row for each mesh of an adaptive
/// run with the vertical load or, if a load is given, the distance.
Progress report_progress(std::ostream& out, const Scene& scene);

/// Prints a line for a mesh of an adaptive run if there was none for five seconds.
Progress report_long_runs(std::ostream& out);

} // namespace rollwave
