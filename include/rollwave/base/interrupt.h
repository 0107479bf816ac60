#pragma once

#include <mpi.h>

namespace rollwave {

/// From here on the first SIGINT (Ctrl-C), SIGTERM, SIGUSR1 or SIGUSR2 sets a flag; the same signal
/// once more ends the program at once. Those that the parent process ignores stay ignored. A write
/// to a closed pipe, or beyond the limit of file sizes (ulimit -f), then fails as an error of the
/// stream instead of ending the program.
/// @param reports true to print a message on the standard error when the flag is set
void install_signal_handlers(bool reports = true);

/// True if the flag is set on any process; all of them must call it. A refinement asks once for
/// each mesh, a study once for each run, and both end with what they have. Uzawa's method asks in
/// each step, the exact answer for each half-width, and both end without a result.
bool is_interrupted(MPI_Comm communicator);

} // namespace rollwave
