#include "command_line.h"
#include "errors.h"
#include "memory.h"
#include "output.h"
#include "parameters.h"
#include "process.h"
#include "processes.h"
#include "report.h"
#include "simulation.h"
#include "study.h"
#include "study_output.h"
#include "true_errors.h"
#include "verification.h"
#include "version.h"

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <iostream>
#include <new>
#include <sstream>

using namespace rollwave;

namespace {

void run(const CommandLine& line, std::ostream& out, const Processes& processes) {
  const MPI_Comm communicator = processes.communicator();
  reserve_blas_memory();
  const Parameters parameters = read_parameters(settings_of(line));
  const bool is_study = !parameters.study.vary.empty() || !parameters.study.scenes.empty();
  if (is_study && line.verify)
    throw BadInput("--verify is for a single scene; a study has Study/True errors = true");
  const Scene scene = make_scene(parameters);
  const auto directory = prepare_directory(parameters, communicator);

  report_scene(out, scene, parameters);
  if (is_study) {
    const Study study = run_study(parameters, directory, out, communicator);
    if (processes.is_first()) {
      out << '\n';
      print_study(out, study.runs);
      report_files(out, write_study(directory, parameters, study.runs));
    }
    processes.wait_for_first();
    if (!study.shortfall.empty())
      throw NotSolved(study.shortfall);
    if (processes.is_first() && std::none_of(study.runs.begin(), study.runs.end(),
                                             [](const StudyRun& run) { return run.is_solved(); }))
      throw NotSolved("no run of the study was solved; the first: " + study.runs.front().failure);
    return;
  }
  Solution solution = simulate(scene, parameters, communicator);
  report_result(out, to_lengths(solution.result, scene.unit));
  if (line.verify) {
    if (const auto exact = find_exact_solution(scene, parameters)) {
      solution.result.errors =
          measure_true_errors(*solution.space, solution.displacement, solution.result,
                              solution.certificate, exact_reference(*exact));
      report_verification(out, scene, solution.result, *exact);
    } else
      out << "\nNo exact solution is known for this scene: its force is not constant, its "
             "zone cuts the contact short unevenly, or the contact is too long beside the "
             "thickness of the ring.\n";
  }
  const WrittenFiles written = write_results(directory, scene, parameters, solution);
  report_end(out, solution.result.work, written);
  processes.wait_for_first();
  if (!solution.result.shortfall.empty())
    throw NotSolved(solution.result.shortfall);
}

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
    run(line, out, processes);
  }
}

} // namespace

int main(int argc, char* argv[]) {
  settle_process(argv);
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
