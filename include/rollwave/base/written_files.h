#pragma once

#include "rollwave/base/note.h"

#include <mpi.h>

#include <filesystem>
#include <string>
#include <vector>

namespace rollwave {

/// The files of a run, and notes on those that could not be written.
struct WrittenFiles {
  std::vector<std::filesystem::path> files;
  std::vector<Note> notes;
  unsigned long n_bytes = 0;

  /// Writes a file. @throws NotWritten.
  void write(const std::filesystem::path& path, const std::string& content);

  /// Writes a file of which each process has a part, see write_file_in_parts(). @throws NotWritten
  /// on all of them
  void write_parts(const std::filesystem::path& path, const std::string& part,
                   MPI_Comm communicator);

  /// Adds a remark that names those of the files @p older that were not written.
  void note_older_files(const std::vector<std::filesystem::path>& older);
};

} // namespace rollwave
