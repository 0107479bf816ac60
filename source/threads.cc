#include "threads.h"

#include "memory.h"

#include <deal.II/base/multithread_info.h>

namespace rollwave {

std::launch launch_beside() {
  if (dealii::MultithreadInfo::n_threads() == 1 || is_memory_scarce())
    return std::launch::deferred;
  return std::launch::async | std::launch::deferred;
}

} // namespace rollwave
