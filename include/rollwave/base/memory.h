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

/// OpenBLAS reserves 128 MiB of address space for each thread when the program is loaded, and waits
/// for ever if there is no room. If the address space is limited (ulimit -v), this function starts
/// the program again with one thread, unless OPENBLAS_NUM_THREADS or OMP_NUM_THREADS is set. It
/// then makes OpenBLAS take its buffer before other memory is used.
/// @param argv of main()
/// @return false if the buffer does not fit
bool fit_blas_into_address_space(char** argv);

/// The largest amount of memory that this process has held so far, in MiB.
double peak_memory_mib();

} // namespace rollwave
