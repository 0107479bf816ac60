#ifndef ROLLWAVE_BASE_MEMORY_H
#define ROLLWAVE_BASE_MEMORY_H

#include <mpi.h>

#include <string>

namespace rollwave {

/// From how many unknowns on memory counts more than time, and threads of BLAS gain any: with fewer
/// a factor and all else stay below half a GiB.
constexpr unsigned int many_unknowns = 400000;

/// The bytes that the machine, or what a batch system gives of it, has left without taking them
/// from others; infinity where that is not known.
double available_memory();

/// Refuses work that would drive the machine out of memory, where the system might end any process
/// instead of failing an allocation. All processes of @p communicator must ask.
/// @param bytes that this process needs @param purpose what needs them
/// @throws NotEnoughMemory on all processes when one of them lacks its bytes, or a machine those of
///         its processes.
void require_memory(double bytes, const std::string& purpose,
                    MPI_Comm communicator = MPI_COMM_SELF);

/// Returns to the system what this process has freed but still holds, where the C library can do
/// so.
void release_freed_memory();

/// The largest amount of memory this process has held so far, in MiB.
double peak_memory_mib();

} // namespace rollwave

#endif
