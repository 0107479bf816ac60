#ifndef ROLLWAVE_PROGRAM_H
#define ROLLWAVE_PROGRAM_H

#include "rollwave/base/mpi_processes.h"
#include "rollwave/parameters/command_line.h"

#include <iosfwd>

namespace rollwave {

/// Solves the scene or the study of the parameter file, writes its files and reports on @p out.
/// @throws BadInput, NotSolved (when what there is has been written) or NotWritten.
void run_program(const CommandLine& line, const Processes& processes, std::ostream& out);

} // namespace rollwave

#endif
