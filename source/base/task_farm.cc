#include "rollwave/base/task_farm.h"

#include "rollwave/base/mpi_processes.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

namespace rollwave {

namespace {

constexpr int tag = 1;
constexpr int no_task = -1;

/// Waits without keeping a core busy, as a blocking MPI_Recv() may.
MPI_Status wait_for_message(MPI_Comm communicator) {
  MPI_Status status;
  for (int has_come = 0;;) {
    MPI_Iprobe(MPI_ANY_SOURCE, tag, communicator, &has_come, &status);
    if (has_come)
      return status;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

void hand_out(MPI_Comm communicator, unsigned int n_groups, unsigned int n_tasks,
              const std::function<bool(unsigned int task, const std::string& result)>& end) {
  const unsigned int n_processes = count_processes(communicator);
  std::vector<int> task_of(n_processes, no_task);
  unsigned int next = 0;
  for (unsigned int n_waiting = 0; n_waiting < n_groups;) {
    const MPI_Status status = wait_for_message(communicator);
    int length = 0;
    MPI_Get_count(&status, MPI_CHAR, &length);
    std::string result(length, ' ');
    MPI_Recv(result.data(), length, MPI_CHAR, status.MPI_SOURCE, tag, communicator,
             MPI_STATUS_IGNORE);
    int& task = task_of[status.MPI_SOURCE];
    if (task != no_task && !end(task, result))
      n_tasks = next;
    task = next < n_tasks ? int(next++) : no_task;
    if (task == no_task)
      ++n_waiting;
    MPI_Send(&task, 1, MPI_INT, status.MPI_SOURCE, tag, communicator);
  }
}

} // namespace

void farm_out(MPI_Comm communicator, unsigned int group_size, unsigned int n_tasks,
              const std::function<bool(unsigned int task, const std::string& result)>& end,
              const std::function<std::string(unsigned int task, MPI_Comm group)>& work) {
  const unsigned int n_groups = (count_processes(communicator) - 1) / group_size;
  const unsigned int process = process_number(communicator);
  // The groups are numbered from 1 on.
  const int number = process == 0 ? 0 : 1 + std::min((process - 1) / group_size, n_groups - 1);
  MPI_Comm group;
  MPI_Comm_split(communicator, number, process, &group);
  if (process == 0)
    hand_out(communicator, n_groups, n_tasks, end);
  else
    for (std::string result;;) {
      int task = no_task;
      if (process_number(group) == 0) {
        MPI_Send(result.data(), result.size(), MPI_CHAR, 0, tag, communicator);
        MPI_Recv(&task, 1, MPI_INT, 0, tag, communicator, MPI_STATUS_IGNORE);
      }
      MPI_Bcast(&task, 1, MPI_INT, 0, group);
      if (task == no_task)
        break;
      result = work(task, group);
    }
  MPI_Comm_free(&group);
}

} // namespace rollwave
