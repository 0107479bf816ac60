#pragma once

#include "rollwave/base/written_files.h"
#include "rollwave/parameters/parameters.h"

#include <mpi.h>

#include <filesystem>
#include <set>
#include <vector>

namespace rollwave {

/// Writes parameters.prm, the complete parameter file of a run with the version of the program in
/// its first line. If parameters.prm is the file that was read, even through a link, it is left as
/// it is, and a remark is added. @throws NotWritten.
void write_parameters(const std::filesystem::path& directory, const Parameters& parameters,
                      WrittenFiles& written);

/// Refuses a directory in which parameters.prm, or summary.json if it is one of the @p kinds to
/// write, is not a file of this program. The parameter file that was read is never written, and may
/// be there. @throws BadValue
void check_own_files(const std::filesystem::path& directory, const Parameters& parameters,
                     const std::set<OutputFile>& kinds);

/**
 * Makes the directory of a run, on rank 0 for all.
 *
 * @return the files in it if it has the parameters.prm of an earlier run, else none
 * @throws BadValue when the directory cannot be made or written into, and as check_own_files();
 *         NotWritten when there is no space for it
 */
std::vector<std::filesystem::path> prepare_directory(const Parameters& parameters, bool is_study,
                                                     MPI_Comm communicator);

} // namespace rollwave
