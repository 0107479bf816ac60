#ifndef ROLLWAVE_MEMORY_H
#define ROLLWAVE_MEMORY_H

#include <string>

namespace rollwave {

/// Refuses work that would drive the machine out of memory, where the system might end any process
/// instead of failing an allocation. Does nothing where the free memory is not known.
/// @throws NotEnoughMemory when less than @p bytes are available; @p purpose says what needs them.
void require_memory(double bytes, const std::string& purpose);

/// Returns to the system what this process has freed but still holds, where the C library can do
/// so.
void release_freed_memory();

/// The largest amount of memory this process has held so far, in MiB.
double peak_memory_mib();

} // namespace rollwave

#endif
