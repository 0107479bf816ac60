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
/// its first line. The file that was read, by whatever name, is never written over: then there is a
/// remark. @throws NotWritten.
void write_parameters(const std::filesystem::path& directory, const Parameters& parameters,
                      WrittenFiles& written);

/// True if parameters.prm in the directory of @p parameters is what write_parameters() writes: a
/// study then goes on.
bool is_of_same_run(const Parameters& parameters);

/**
 * Makes the directory of a run, on rank 0 for all. Where an earlier run has left its parameters.prm
 * it removes the files of that run that this one will not write, by the fixed names of this
 * program.
 *
 * @return the names of the removed files
 * @throws BadValue when the directory cannot be made or written into, NotWritten when there is no
 *         space for it
 */
std::vector<std::string> prepare_directory(const Parameters& parameters, bool is_study,
                                           MPI_Comm communicator);

} // namespace rollwave
