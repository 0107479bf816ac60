#include "command_line.h"
#include "errors.h"
#include "output.h"
#include "parameters.h"
#include "report.h"
#include "simulation.h"
#include "study.h"
#include "study_output.h"
#include "true_errors.h"
#include "verification.h"
#include "version.h"

#include <deal.II/grid/tria.h>

#include <csignal>
#include <iostream>
#include <new>

namespace {

using namespace rollwave;

void run(const CommandLine& line) {
  std::vector<Setting> settings = read_settings(line.file);
  settings.insert(settings.end(), line.settings.begin(), line.settings.end());
  const Parameters parameters = read_parameters(settings);
  const Scene scene = make_scene(parameters);
  const auto directory = prepare_directory(parameters);

  report_scene(std::cout, scene, parameters);
  if (!parameters.study.vary.empty() || !parameters.study.scenes.empty()) {
    const auto runs = run_study(parameters, directory, std::cout);
    std::cout << '\n';
    print_study(std::cout, runs);
    report_files(std::cout, write_study(directory, parameters, runs));
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
      std::cout << "\nNo exact solution is known for this scene: its force is not constant, or its "
                   "zone cuts the contact short unevenly.\n";
  }
  const WrittenFiles written = write_results(directory, scene, parameters, solution);
  report_end(std::cout, solution.result.work, written);
  if (!solution.result.shortfall.empty())
    throw NotSolved(solution.result.shortfall);
}

int act(const std::vector<std::string>& arguments) {
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
  return 0;
}

} // namespace

int main(int argc, char* argv[]) {
  // A file that grows beyond the limit shall be an error of the stream, not the end of the process.
  std::signal(SIGXFSZ, SIG_IGN);

  const auto fail = [](const std::string& kind, const std::string& message, int code) {
    std::cout << std::flush;
    std::cerr << "rollwave: " << kind << message << std::endl;
    return code;
  };
  try {
    return act({argv + 1, argv + argc});
  } catch (const rollwave::BadInput& error) {
    return fail("", error.what(), 1);
  } catch (const rollwave::NotSolved& error) {
    return fail("not solved: ", error.what(), 2);
  } catch (const rollwave::NotWritten& error) {
    return fail("not written: ", error.what(), 3);
  } catch (const std::bad_alloc&) {
    return fail("not solved: ",
                "not enough memory; lower Mesh/Radial cells, Mesh/Angular cells or "
                "Mesh/Global refinements",
                2);
  } catch (const std::exception& error) {
    return fail("not solved: ", error.what(), 2);
  }
}
