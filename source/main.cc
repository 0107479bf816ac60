#include "rollwave/base/errors.h"
#include "rollwave/base/interrupt.h"
#include "rollwave/base/start.h"
#include "rollwave/base/version.h"
#include "rollwave/parameters/command_line.h"
#include "rollwave/parameters/parameters.h"
#include "rollwave/program.h"
#include "rollwave/run/attempt.h"
#include "rollwave/run/quantity_table.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <new>
#include <optional>
#include <sstream>
#include <thread>

using namespace rollwave;

namespace {

/// True if a launcher has started several processes, by the variables of Open MPI, MPICH and PMIx.
bool is_launched_by_mpi() {
  for (const char* const variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* const size = std::getenv(variable))
      return std::strtol(size, nullptr, 10) > 1;
  return std::getenv("PMIX_RANK") != nullptr;
}

void run_action(const std::vector<std::string>& arguments, MPI_Comm communicator,
                std::ostream& out) {
  const CommandLine line = read_command_line(arguments);
  switch (line.action) {
  case CommandLine::Action::help:
    out << usage();
    break;
  case CommandLine::Action::version:
    out << version_text() << '\n';
    break;
  case CommandLine::Action::parameters: {
    // deal.II throws where it cannot write.
    std::ostringstream text;
    print_parameters(text, read_parameters(settings_of(line, communicator)));
    out << text.str();
    break;
  }
  case CommandLine::Action::quantities:
    print_quantities(out);
    break;
  case CommandLine::Action::run:
    run_program(line, communicator, out);
  }
}

} // namespace

int main(int argc, char* argv[]) {
  const bool has_memory = take_blas_buffer();
  install_signal_handlers();
  std::optional<dealii::Utilities::MPI::MPI_InitFinalize> mpi;
  unsigned int rank = 0;
  if (is_launched_by_mpi()) {
    int n_arguments = 1; // PETSc starts with MPI and would reject the others
    mpi.emplace(n_arguments, argv, /*max_num_threads=*/1);
    rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    install_signal_handlers(rank == 0); // PETSc has replaced them
  }
  // Reports an error and ends all processes. Rank 0 does so at once. Another one gives it time for
  // that, since all processes may have the error. If none has ended the program by then, it has the
  // error alone, and the others wait for its messages.
  const auto fail = [&](const std::string& message, int code) {
    if (rank > 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(5000 + 200 * rank));
    std::cout << std::flush;
    // In one piece, since launchers mix what processes write.
    std::cerr << "rollwave: " + message + '\n' << std::flush;
    if (mpi)
      MPI_Abort(MPI_COMM_WORLD, code);
    return code;
  };
  try {
    if (!has_memory)
      throw NotSolved("not enough memory; raise the limit of the address space (ulimit -v)");
    std::ostream silence(nullptr);
    run_action({argv + 1, argv + argc}, mpi ? MPI_COMM_WORLD : MPI_COMM_SELF,
               rank == 0 ? std::cout : silence);
    if (rank == 0 && !(std::cout << std::flush))
      throw NotWritten("the standard output could not be written to");
    return 0;
  } catch (const BadInput& error) {
    return fail(error.what(), 1);
  } catch (const NotWritten& error) {
    return fail(error.what(), 3);
  } catch (const TargetNotReached& error) {
    return fail(std::string("target not reached: ") + error.what(), 2);
  } catch (const NotSolved& error) {
    return fail(std::string("not solved: ") + error.what(), 2);
  } catch (const std::bad_alloc&) {
    return fail(std::string("not solved: ") + NotEnoughMemory().what(), 2);
  } catch (const dealii::ExcOutOfMemory&) { // by the vectors of deal.II
    return fail(std::string("not solved: ") + NotEnoughMemory().what(), 2);
  } catch (const std::exception& error) { // of a library
    return fail("not solved: " + reason_of(error), 2);
  }
}
