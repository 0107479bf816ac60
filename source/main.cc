#include "command_line.h"
#include "errors.h"
#include "memory.h"
#include "output.h"
#include "parameters.h"
#include "process.h"
#include "report.h"
#include "simulation.h"
#include "study.h"
#include "study_output.h"
#include "true_errors.h"
#include "verification.h"
#include "version.h"

#include <deal.II/grid/tria.h>

#include <iostream>
#include <new>

using namespace rollwave;

namespace {

void run(const CommandLine& line) {
  reserve_blas_memory();
  std::vector<Setting> settings = read_settings(line.file);
  settings.insert(settings.end(), line.settings.begin(), line.settings.end());
  const Parameters parameters = read_parameters(settings);
  const Scene scene = make_scene(parameters);
  const auto directory = prepare_directory(parameters);

  report_scene(std::cout, scene, parameters);
  if (!parameters.study.vary.empty() || !parameters.study.scenes.empty()) {
    const Study study = run_study(parameters, directory, std::cout);
    std::cout << '\n';
    print_study(std::cout, study.runs);
    report_files(std::cout, write_study(directory, parameters, study.runs));
    if (!study.shortfall.empty())
      throw NotSolved(study.shortfall);
    return;
  }
  Solution solution = simulate(scene, parameters);
  report_result(std::cout, to_lengths(solution.result, scene.unit));
  if (line.verify) {
    if (const auto exact = find_exact_solution(scene, parameters)) {
      solution.result.errors =
          measure_true_errors(*solution.space, solution.displacement, solution.result,
                              solution.certificate, exact_reference(*exact));
      report_verification(std::cout, scene, solution.result, *exact);
    } else
      std::cout << "\nNo exact solution is known for this scene: its force is not constant, its "
                   "zone cuts the contact short unevenly, or the contact is too long beside the "
                   "thickness of the ring.\n";
  }
  const WrittenFiles written = write_results(directory, scene, parameters, solution);
  report_end(std::cout, solution.result.work, written);
  if (!solution.result.shortfall.empty())
    throw NotSolved(solution.result.shortfall);
}

void act(const std::vector<std::string>& arguments) {
  const CommandLine line = read_command_line(arguments);
  switch (line.action) {
  case CommandLine::Action::help:
    std::cout << usage();
    break;
  case CommandLine::Action::version:
    std::cout << version_text() << '\n';
    break;
  case CommandLine::Action::parameters:
    print_parameters(std::cout, line.settings);
    break;
  case CommandLine::Action::run:
    run(line);
  }
}

} // namespace

int main(int argc, char* argv[]) {
  settle_process(argv);
  const auto fail = [](const std::string& kind, const std::string& message, int code) {
    std::cout << std::flush;
    std::cerr << "rollwave: " << kind << message << std::endl;
    return code;
  };
  try {
    act({argv + 1, argv + argc});
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
