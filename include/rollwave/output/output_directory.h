#ifndef ROLLWAVE_OUTPUT_OUTPUT_DIRECTORY_H
#define ROLLWAVE_OUTPUT_OUTPUT_DIRECTORY_H

#include "rollwave/parameters/parameters.h"

#include <mpi.h>

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace rollwave {

/// What has been written, and what could not be.
struct WrittenFiles {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> remarks;
};

/// The complete parameter file of a run, with the versions of the program in its first line.
void write_parameters(std::ostream& out, const Parameters& parameters);

/// Whether @p path is the parameter file that was read, by whatever name: it is never written over.
bool is_input(const Parameters& parameters, const std::filesystem::path& path);

/// Renames study.csv and study.jsonl of a directory to the first names study-before that are free.
/// @return the name without its ending; empty where there is none of them
/// @throws NotWritten when a file cannot be moved
std::string set_study_aside(const std::filesystem::path& directory);

/**
 * The directory that a run writes into, from its beginning to its end. The record in it, which
 * names the files that this program has written there, is locked by the kernel meanwhile, so that
 * no other run writes there.
 */
class OutputDirectory {
public:
  /// Makes the directory, on one process for all, and removes what killed runs have left half
  /// written. @throws BadValue when it cannot be made or written into, or another run does,
  ///         NotWritten when there is no space for it.
  OutputDirectory(const Parameters& parameters, MPI_Comm communicator);
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

  const std::filesystem::path& path() const { return directory; }

  /// The files that earlier runs of this program have written here, and this one has not.
  std::vector<std::string> files_of_earlier_runs() const;

  /// At the end of a run: removes these, keeping the table of a study, and says so in @p written.
  void remove_files_of_earlier_runs(WrittenFiles& written);

private:
  std::vector<std::string> recorded() const;

  std::filesystem::path directory;
  const Parameters& parameters;
  int record = -1;           ///< descriptor, on the first process
  std::size_t n_earlier = 0; ///< entries of the record that are of earlier runs
};

} // namespace rollwave

#endif
