#pragma once

#include "rollwave/output/output_directory.h"
#include "rollwave/run/simulation.h"

#include <string>
#include <vector>

namespace rollwave {

/// The names of the files that write_results() writes with these options.
std::vector<std::string> result_file_names(const OutputOptions& output);

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
