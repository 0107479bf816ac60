#pragma once

#include <mpi.h>

#include <string>

namespace rollwave {

// MPI need not run for these: without it there is one process.

/// True for the communicator of one process.
bool is_serial(MPI_Comm communicator);

unsigned int count_processes(MPI_Comm communicator);

/// The rank of this process in a communicator.
unsigned int process_number(MPI_Comm communicator);

/// The text of rank 0, on all ranks.
std::string broadcast(MPI_Comm communicator, const std::string& text);

/// The text of the first rank that has one, on all ranks; empty if no rank has one.
std::string first_text(MPI_Comm communicator, const std::string& text);

} // namespace rollwave
