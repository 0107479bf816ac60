#pragma once

#include "rollwave/base/written_files.h"
#include "rollwave/parameters/parameters.h"

#include <mpi.h>

#include <filesystem>
#include <string>
#include <vector>

namespace rollwave {

/// Writes parameters.prm, the complete parameter file of a run with the version of the program in
/// its first line. If parameters.prm is the file that was read, even through a link, it is left as
/// it is, and a remark is added. @throws NotWritten.
void write_parameters(const std::filesystem::path& directory, const Parameters& parameters,
                      WrittenFiles& written);

/**
 * Makes the directory of a run, on rank 0 for all.
 *
 * @param names of all files that the run will write in it
 * @return the files in it if it has the parameters.prm of an earlier run, else none
 * @throws BadValue when the directory cannot be made or written into, when one of these files is
 *         the parameter file that is read (except parameters.prm, which write_parameters() then
 *         leaves as it is), or is there without the parameters.prm of an earlier run;
 *         NotWritten when there is no space for the directory
 */
std::vector<std::filesystem::path> prepare_directory(const Parameters& parameters,
                                                     const std::vector<std::string>& names,
                                                     MPI_Comm communicator);

} // namespace rollwave
