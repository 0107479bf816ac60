#ifndef ROLLWAVE_OUTPUT_OUTPUT_DIRECTORY_H
#define ROLLWAVE_OUTPUT_OUTPUT_DIRECTORY_H

#include "rollwave/parameters/parameters.h"
#include "rollwave/run/solution.h"
#include "rollwave/scene/scene.h"

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace rollwave {

/// Makes the directory of the files, on one process for all. @throws BadInput when it cannot be
/// made or written into, NotWritten when there is no space for it.
std::filesystem::path prepare_directory(const Parameters& parameters, MPI_Comm communicator);

/// What has been written, and what could not be drawn.
struct WrittenFiles {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> remarks;
};

/// Writes the files that @p parameters ask for: on several processes each its part of the field,
/// one of them the others. The time is added to the work of @p solution, whose summary is written
/// last. @throws NotWritten.
WrittenFiles write_results(const std::filesystem::path& directory, const Scene& scene,
                           const Parameters& parameters, Solution& solution);

/// The complete parameter file of a run, with the versions of the program in its first line.
void write_parameters(std::ostream& out, const Parameters& parameters);

} // namespace rollwave

#endif
