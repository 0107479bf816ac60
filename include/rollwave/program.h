#pragma once

#include "rollwave/parameters/command_line.h"

#include <mpi.h>

#include <iosfwd>

namespace rollwave {

/// Solves the scene or the study of the parameter file, writes its files and reports on @p out.
/// All processes of @p communicator call it; @p out is that of rank 0.
/// @throws BadInput, NotSolved (when what there is has been written) or NotWritten
void run_program(const CommandLine& line, MPI_Comm communicator, std::ostream& out);

} // namespace rollwave
