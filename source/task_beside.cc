#include "task_beside.h"

#include "memory.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>

#include <dlfcn.h>
#include <utility>

namespace rollwave {

namespace {

/// A function of the BLAS that the program was loaded with; nullptr where that is another.
template <typename Function>
Function* of_openblas(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

/// 1 where BLAS is another.
int blas_threads() {
  const auto get = of_openblas<int()>("openblas_get_num_threads");
  return get ? get() : 1;
}

void set_blas_threads(int n_threads) {
  of_openblas<void(int)>("openblas_set_num_threads")(n_threads);
}

} // namespace

bool gains_by_threads() {
  return dealii::MultithreadInfo::n_threads() > 1 && !dealii::Utilities::MPI::job_supports_mpi() &&
         !memory_below_limit();
}

BlasOnOneThread::BlasOnOneThread() : n_threads(blas_threads()) {
  if (n_threads > 1)
    set_blas_threads(1);
}

BlasOnOneThread::~BlasOnOneThread() {
  if (n_threads > 1)
    set_blas_threads(n_threads);
}

TaskBeside::TaskBeside(bool in_thread, std::function<void()> task) {
  if (in_thread)
    blas.emplace();
  done = std::async(in_thread ? std::launch::async | std::launch::deferred : std::launch::deferred,
                    std::move(task));
}

void TaskBeside::finish() {
  done.get();
  blas.reset();
}

} // namespace rollwave
