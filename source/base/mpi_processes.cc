#include "rollwave/base/mpi_processes.h"

#include "rollwave/base/interrupt.h"

#include <deal.II/base/mpi.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

namespace rollwave {

using namespace dealii;

namespace {

/// By the variables of Open MPI, of MPICH with its relatives, and of PMIx, which tells no number.
bool is_launched_with_others() {
  for (const char* const variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* const size = std::getenv(variable))
      return std::strtol(size, nullptr, 10) > 1;
  return std::getenv("PMIX_RANK") != nullptr;
}

} // namespace

Processes::Processes(int& argc, char**& argv) {
  const KeptInterrupts kept;
  if (is_launched_with_others())
    mpi = std::make_unique<Utilities::MPI::MPI_InitFinalize>(argc, argv, /*max_num_threads=*/1);
  if (!is_first())
    note_interrupts_silently();
}

Processes::~Processes() = default;

bool Processes::is_first() const {
  return process_number(communicator()) == 0;
}

void Processes::wait_for_first() const {
  share_text(communicator(), {});
}

void Processes::let_first_speak() const {
  if (!is_first())
    std::this_thread::sleep_for(
        std::chrono::milliseconds(2000 + 200 * process_number(communicator())));
}

int Processes::end(int exit_code) const {
  if (mpi)
    MPI_Abort(MPI_COMM_WORLD, exit_code);
  return exit_code;
}

unsigned int count_processes(MPI_Comm communicator) {
  return Utilities::MPI::job_supports_mpi() ? Utilities::MPI::n_mpi_processes(communicator) : 1;
}

bool is_alone(MPI_Comm communicator) {
  return count_processes(communicator) == 1;
}

unsigned int process_number(MPI_Comm communicator) {
  return is_alone(communicator) ? 0 : Utilities::MPI::this_mpi_process(communicator);
}

double sum_on_machine(MPI_Comm communicator, double value) {
  if (is_alone(communicator))
    return value;
  MPI_Comm machine;
  MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  const double sum = Utilities::MPI::sum(value, machine);
  MPI_Comm_free(&machine);
  return sum;
}

std::string share_text(MPI_Comm communicator, const std::string& text) {
  return is_alone(communicator) ? text : Utilities::MPI::broadcast(communicator, text);
}

std::string first_text(MPI_Comm communicator, const std::string& text) {
  if (is_alone(communicator))
    return text;
  const unsigned int none = count_processes(communicator);
  const unsigned int first =
      Utilities::MPI::min(text.empty() ? none : process_number(communicator), communicator);
  return first < none ? Utilities::MPI::broadcast(communicator, text, first) : std::string();
}

} // namespace rollwave
