#ifndef ROLLWAVE_BASE_MEMORY_H
#define ROLLWAVE_BASE_MEMORY_H

#include <mpi.h>

#include <filesystem>
#include <string>

namespace rollwave {

/**
 * The bytes that the control groups of this process leave, by which Linux limits the memory of
 * batch jobs and containers: the least of limit - use + files in memory that are not in use, over
 * the group and those it is in. Infinity without a limit, or where that is not known. Of both
 * versions of control groups.
 *
 * @param groups the file that names the groups @param root where they are mounted
 */
double memory_of_control_groups(const std::filesystem::path& groups,
                                const std::filesystem::path& root);

/// Refuses work that would drive the machine, or what a batch system gives of it, out of memory,
/// where the system might end any process instead of failing an allocation. All processes of @p
/// communicator must ask.
/// @param bytes that this process needs @param purpose what needs them
/// @throws NotEnoughMemory on all processes when the bytes of all on one machine are not there.
void require_memory(double bytes, const std::string& purpose,
                    MPI_Comm communicator = MPI_COMM_SELF);

/// Makes OpenBLAS fit a limited address space (ulimit -v), of which its buffer takes 128 MiB for
/// each thread as soon as the program is loaded; without room it would wait for ever. There the
/// program starts itself again with one thread, unless OPENBLAS_NUM_THREADS or OMP_NUM_THREADS is
/// set, and takes the buffer before anything else.
/// @param argv of main()
/// @return false if the buffer does not fit
bool fit_blas_into_address_space(char** argv);

/// The largest amount of memory this process has held so far, in MiB.
double peak_memory_mib();

} // namespace rollwave

#endif
