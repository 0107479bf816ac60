#ifndef ROLLWAVE_BASE_TASK_FARM_H
#define ROLLWAVE_BASE_TASK_FARM_H

#include <mpi.h>

#include <functional>
#include <string>

namespace rollwave {

/// What the first process does, which hands out the tasks.
struct Foreman {
  std::function<void(unsigned int task)> begin; ///< when a task is handed out

  /// When its result has come. False when no other task shall be begun.
  std::function<bool(unsigned int task, const std::string& result)> end;
};

/**
 * Hands out the tasks from 0 to @p n_tasks - 1, in this order, to groups of @p group_size
 * processes, the next one to the group that is free. The first process hands out and sleeps in
 * between; of the others, those that do not fill a group join the last one.
 *
 * @param work does a task, together with the other processes of the group; the text that it returns
 *        on the first of them is the result
 */
void farm_out(MPI_Comm communicator, unsigned int group_size, unsigned int n_tasks,
              const Foreman& foreman,
              const std::function<std::string(unsigned int task, MPI_Comm group)>& work);

} // namespace rollwave

#endif
