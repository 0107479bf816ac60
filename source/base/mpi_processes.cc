#include "rollwave/base/mpi_processes.h"

#include "rollwave/base/errors.h"

#include <deal.II/base/mpi.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

namespace rollwave {

using namespace dealii;

namespace {

/// The number of processes that the first of these variables tells; 0 without any.
long launched_processes(std::initializer_list<const char*> variables) {
  for (const char* const variable : variables)
    if (const char* const number = std::getenv(variable))
      return std::strtol(number, nullptr, 10);
  return 0;
}

/// By the variables of Open MPI, of MPICH with its relatives, and of PMIx, which tells no number.
bool is_launched_by_mpi() {
  const long number = launched_processes({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"});
  return number > 1 || (number == 0 && std::getenv("PMIX_RANK"));
}

} // namespace

Processes::Processes(char** argv) {
  // The name alone: deal.II hands the arguments to PETSc too, which complains of all of them.
  int argc = 1;
  if (is_launched_by_mpi())
    mpi = std::make_unique<Utilities::MPI::MPI_InitFinalize>(argc, argv, /*max_num_threads=*/1);
}

Processes::~Processes() = default;

bool Processes::is_first() const {
  return process_number(communicator()) == 0;
}

void Processes::require_company() const {
  // The last one is that of a job step of Slurm: a batch script and what it starts have none.
  const long number =
      launched_processes({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"});
  if (number > 1 && is_alone(communicator()))
    throw BadInput("this is one of " + std::to_string(number) +
                   " processes that do not find each other, so that each would solve the whole "
                   "scene: start them by the mpirun of the MPI that Rollwave is built with, or by "
                   "srun --mpi=pmix, or say --single if that is what you want");
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

MpiSession::MpiSession() {
  // Not deal.II's MPI_InitFinalize, which must end within main(): it empties pools that are gone
  // when the program ends.
  if (!Utilities::MPI::job_supports_mpi()) {
    MPI_Init(nullptr, nullptr);
    std::atexit([] { MPI_Finalize(); });
  }
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

std::string share_text(MPI_Comm communicator, const std::string& text) {
  return Utilities::MPI::all_gather(communicator, text).front();
}

std::string first_text(MPI_Comm communicator, const std::string& text) {
  for (const std::string& of_one : Utilities::MPI::all_gather(communicator, text))
    if (!of_one.empty())
      return of_one;
  return {};
}

} // namespace rollwave
