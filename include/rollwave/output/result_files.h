#pragma once

#include "rollwave/output/output_directory.h"
#include "rollwave/run/simulation.h"

namespace rollwave {

/// Writes the files that @p parameters ask for: on several processes each its part of the field,
/// one of them the others. The time is added to the work of @p solution, whose summary is written
/// last. @throws NotWritten.
WrittenFiles write_results(const std::filesystem::path& directory, const Parameters& parameters,
                           Solution& solution);

} // namespace rollwave
