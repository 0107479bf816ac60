#ifndef ROLLWAVE_TASK_BESIDE_H
#define ROLLWAVE_TASK_BESIDE_H

#include <functional>
#include <future>
#include <optional>

namespace rollwave {

/// Whether a second thread gains time: not on one core or with DEAL_II_NUM_THREADS=1. Nor may there
/// be one beside MPI, which two threads may not call at once, or below a limit of memory, of which
/// BLAS takes more for each thread and waits for ever for what it does not get.
bool gains_by_threads();

/// Keeps OpenBLAS on one thread while it lives. Calls by two threads would wait for each other to
/// use those of its own, and take several times as long.
class BlasOnOneThread {
public:
  BlasOnOneThread();
  ~BlasOnOneThread();
  BlasOnOneThread(const BlasOnOneThread&) = delete;
  BlasOnOneThread& operator=(const BlasOnOneThread&) = delete;

private:
  const int n_threads; ///< before
};

/// A task that may go on beside its caller.
class TaskBeside {
public:
  /// Starts it in a thread of its own, if one is wanted and to be had; else it is done in finish().
  TaskBeside(bool in_thread, std::function<void()> task);

  /// When it is done. @throws what it throws
  void finish();

private:
  std::optional<BlasOnOneThread> blas; ///< outlives the thread, which the future waits for
  std::future<void> done;
};

} // namespace rollwave

#endif
