#ifndef ROLLWAVE_BASE_TASK_FARM_H
#define ROLLWAVE_BASE_TASK_FARM_H

#include <mpi.h>

#include <functional>
#include <string>

namespace rollwave {

/**
 * Hands out the tasks from 0 to @p n_tasks - 1, in this order, to groups of @p group_size
 * processes, the next one to the group that is free. The first process hands out and sleeps in
 * between; of the others, those that do not fill a group join the last one.
 *
 * @param end what the first process does when a result has come; it returns false when no other
 * task shall be begun
 * @param work does a task, together with the other processes of the group; the text that it returns
 *        on the first of them is the result
 */
void farm_out(MPI_Comm communicator, unsigned int group_size, unsigned int n_tasks,
              const std::function<bool(unsigned int task, const std::string& result)>& end,
              const std::function<std::string(unsigned int task, MPI_Comm group)>& work);

} // namespace rollwave

#endif
