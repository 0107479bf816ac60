#pragma once

#include <mpi.h>

#include <string>

namespace rollwave {

/// Refuses work that needs more memory than the machine has available: the system might end any
/// process instead of failing an allocation. All processes of @p communicator must call it.
/// @param bytes that this process needs @param purpose of the memory, for the message
/// @throws NotEnoughMemory on all processes
void require_memory(double bytes, const std::string& purpose,
                    MPI_Comm communicator = MPI_COMM_SELF);

/// Makes OpenBLAS take its buffer of 128 MiB before other memory is used if the address space is
/// limited (ulimit -v), since OpenBLAS waits for ever where there is no room later.
/// @return false if the buffer does not fit
bool take_blas_buffer();

/// The largest amount of memory that this process has held so far, in MiB.
double peak_memory_mib();

} // namespace rollwave
