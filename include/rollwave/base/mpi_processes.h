#pragma once

#include <mpi.h>

#include <functional>
#include <string>

namespace rollwave {

// MPI need not run for these: without it there is one process.

/// True for the communicator of one process.
bool is_serial(MPI_Comm communicator);

unsigned int count_processes(MPI_Comm communicator);

/// The rank of this process in a communicator.
unsigned int process_number(MPI_Comm communicator);

/// True on all ranks if @p statement is true on all of them.
bool holds_on_all(MPI_Comm communicator, bool statement);

/// The text of rank 0, on all ranks.
std::string broadcast(MPI_Comm communicator, const std::string& text);

/// Does some work of each process for its own, without messages. Where it fails on one, all throw:
/// else the others would wait for its next message. @throws NotEnoughMemory, NotSolved, NotWritten
void do_on_all(MPI_Comm communicator, const std::function<void()>& work);

/// The text of the first rank that has one, on all ranks; empty if no rank has one.
std::string first_text(MPI_Comm communicator, const std::string& text);

} // namespace rollwave
