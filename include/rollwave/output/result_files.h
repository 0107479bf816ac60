#pragma once

#include "rollwave/output/output_directory.h"
#include "rollwave/run/simulation.h"

namespace rollwave {

/// Writes the files that @p parameters ask for. All processes must call it, and rank 0 writes. The
/// seconds are added to the statistics of @p solution. The summary is the last file before the
/// pictures. @throws NotWritten.
WrittenFiles write_results(const std::filesystem::path& directory, const Parameters& parameters,
                           Solution& solution);

/// Writes summary.json, if @p parameters ask for it, with the memory so far. All processes must
/// call it. @throws NotWritten.
void write_summary(const std::filesystem::path& directory, const Parameters& parameters,
                   Solution& solution, WrittenFiles& written);

} // namespace rollwave
