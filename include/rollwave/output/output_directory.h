#pragma once

#include "rollwave/parameters/parameters.h"

#include <mpi.h>

#include <filesystem>
#include <string>
#include <vector>

namespace rollwave {

/// The files of a run, and remarks on those that could not be written.
struct WrittenFiles {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> remarks;
  unsigned long n_bytes = 0;

  /// Writes a file. @throws NotWritten.
  void write(const std::filesystem::path& path, const std::string& content);
};

/// Writes parameters.prm, the complete parameter file of a run with the version of the program in
/// its first line. If parameters.prm is the file that was read, even through a link, it is left as
/// it is, and a remark is added. @throws NotWritten.
void write_parameters(const std::filesystem::path& directory, const Parameters& parameters,
                      WrittenFiles& written);

/// True if parameters.prm in the directory of @p parameters is what write_parameters() writes: a
/// study then goes on.
bool is_of_same_run(const Parameters& parameters);

/**
 * Makes the directory of a run, on rank 0 for all. If it has the parameters.prm of an earlier run,
 * files with the fixed names of this program are removed from it and from its run-NNN directories.
 * A single scene keeps the files that it will write, and a study that continues keeps all.
 *
 * @return the names of the removed files
 * @throws BadValue when the directory cannot be made or written into, NotWritten when there is no
 *         space for it
 */
std::vector<std::string> prepare_directory(const Parameters& parameters, bool is_study,
                                           MPI_Comm communicator);

} // namespace rollwave
