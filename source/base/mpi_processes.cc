#include "rollwave/base/mpi_processes.h"

#include <deal.II/base/mpi.h>

namespace rollwave {

using namespace dealii;

unsigned int count_processes(MPI_Comm communicator) {
  return Utilities::MPI::job_supports_mpi() ? Utilities::MPI::n_mpi_processes(communicator) : 1;
}

bool is_serial(MPI_Comm communicator) {
  return count_processes(communicator) == 1;
}

unsigned int process_number(MPI_Comm communicator) {
  return is_serial(communicator) ? 0 : Utilities::MPI::this_mpi_process(communicator);
}

std::string broadcast(MPI_Comm communicator, const std::string& text) {
  return Utilities::MPI::all_gather(communicator, text).front();
}

std::string first_text(MPI_Comm communicator, const std::string& text) {
  for (const std::string& of_one : Utilities::MPI::all_gather(communicator, text))
    if (!of_one.empty())
      return of_one;
  return {};
}

} // namespace rollwave
