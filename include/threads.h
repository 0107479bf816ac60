#ifndef ROLLWAVE_THREADS_H
#define ROLLWAVE_THREADS_H

#include <future>

namespace rollwave {

/// How std::async() shall run a task that may go on beside its caller: in a thread of its own, if
/// there is one to be had, or when the result is asked for. The latter on one core or with
/// DEAL_II_NUM_THREADS=1, on one of several processes, and where memory is scarce, of which BLAS
/// takes more for each thread and waits for ever for what it does not get.
std::launch launch_beside();

} // namespace rollwave

#endif
