#include "rollwave/base/errors.h"
#include "rollwave/base/interrupt.h"
#include "rollwave/base/memory.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/version.h"
#include "rollwave/parameters/command_line.h"
#include "rollwave/parameters/parameters.h"
#include "rollwave/program.h"

#include <csignal>
#include <fcntl.h>
#include <iostream>
#include <new>
#include <sstream>
#include <unistd.h>
#include <utility>

using namespace rollwave;

namespace {

/// Opens closed standard streams on nothing, lest a result file takes their place.
void open_standard_streams() {
  // What cannot be read from or written to stays so.
  for (const auto& [stream, mode] :
       {std::pair(STDIN_FILENO, O_WRONLY), std::pair(STDOUT_FILENO, O_RDONLY),
        std::pair(STDERR_FILENO, O_RDONLY)})
    if (fcntl(stream, F_GETFD) < 0)
      open("/dev/null", mode);
}

void settle_signals(bool tells_interrupts) {
  // Writing to a full disk or a closed pipe is an error of the stream: a run whose screen goes away
  // still writes its files.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  heed_interrupts(tells_interrupts);
}

void require_equal(const std::vector<std::string>& arguments, MPI_Comm communicator) {
  std::string all;
  for (const std::string& argument : arguments)
    all += argument + '\0';
  if (!first_text(communicator, all == share_text(communicator, all) ? "" : "other").empty())
    throw BadInput("the processes of one run need the same command line, and these have others");
}

void act(const std::vector<std::string>& arguments, const Processes& processes) {
  require_equal(arguments, processes.communicator());
  const CommandLine line = read_command_line(arguments);
  std::ostream silence(nullptr);
  std::ostream& out = processes.is_first() ? std::cout : silence;
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
    print_parameters(text, settings_of(line, processes.communicator()));
    out << text.str();
    break;
  }
  case CommandLine::Action::run:
    if (!line.is_single)
      processes.require_company();
    run_program(line, processes, out);
  }
}

} // namespace

int main(int argc, char* argv[]) {
  open_standard_streams();
  const bool has_memory = fit_blas_into_address_space(argv);
  settle_signals(true);
  const Processes processes(argv);
  settle_signals(processes.is_first()); // PETSc, which deal.II starts with MPI, has undone that
  const auto fail = [&](const std::string& kind, const std::string& message, int code) {
    processes.let_first_speak();
    std::cout << std::flush;
    // In one piece, since launchers mix what processes write.
    std::cerr << "rollwave: " + kind + message + '\n' << std::flush;
    return processes.end(code);
  };
  try {
    if (!has_memory)
      throw NotEnoughMemory();
    act({argv + 1, argv + argc}, processes);
    if (!(std::cout << std::flush))
      throw NotWritten("the standard output could not be written to");
    return 0;
  } catch (const BadInput& error) {
    return fail("", error.what(), 1);
  } catch (const NotWritten& error) {
    return fail("not written: ", error.what(), 3);
  } catch (const std::bad_alloc&) {
    return fail("not solved: ", NotEnoughMemory().what(), 2);
  } catch (const std::exception& error) { // NotSolved, or what a library throws
    return fail("not solved: ", error.what(), 2);
  }
}
