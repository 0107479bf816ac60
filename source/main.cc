#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/system_settings.h"
#include "rollwave/base/version.h"
#include "rollwave/parameters/command_line.h"
#include "rollwave/parameters/parameters.h"
#include "rollwave/program.h"

#include <iostream>
#include <new>
#include <sstream>

using namespace rollwave;

namespace {

void act(const std::vector<std::string>& arguments, const Processes& processes) {
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
    print_parameters(text, settings_of(line));
    out << text.str();
    break;
  }
  case CommandLine::Action::run:
    run_program(line, processes, out);
  }
}

} // namespace

int main(int argc, char* argv[]) {
  settle_process();
  const Processes processes(argc, argv);
  const auto fail = [&](const std::string& kind, const std::string& message, int code) {
    processes.let_first_speak();
    std::cout << std::flush;
    // In one piece, since launchers mix what processes write.
    std::cerr << "rollwave: " + kind + message + '\n' << std::flush;
    return processes.end(code);
  };
  try {
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
