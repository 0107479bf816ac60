#pragma once

#include <mpi.h>

#include <filesystem>
#include <string>

namespace rollwave {

/// The memory in bytes that this process can take: the least of MemAvailable of Linux and of what
/// the limits of its control groups leave (version 1 or 2, as set by Slurm and containers, whose
/// kernel ends a process without a word); cached files that the kernel can drop count as available.
/// Infinity where none of them is known. @param root of the files of the kernel
double available_memory(const std::filesystem::path& root = "/");

/// Refuses work that needs more memory than there is, by available_memory(): the system might end
/// any process instead of failing an allocation. All processes of @p communicator must call it.
/// @param bytes that this process needs @param purpose of the memory, for the message
/// @throws NotEnoughMemory on all processes
void require_memory(double bytes, const std::string& purpose, MPI_Comm communicator);

/// The largest amount of memory that this process has held so far, in MiB; 0 where Linux does not
/// say, without /proc.
double peak_memory_mib();

} // namespace rollwave
