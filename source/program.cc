#include "rollwave/program.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/version.h"
#include "rollwave/output/output_directory.h"
#include "rollwave/output/progress_report.h"
#include "rollwave/output/result_files.h"
#include "rollwave/output/screen_report.h"
#include "rollwave/output/verification_report.h"
#include "rollwave/parameters/parameters.h"
#include "rollwave/run/attempt.h"
#include "rollwave/run/simulation.h"
#include "rollwave/study/study_files.h"
#include "rollwave/study/study_runner.h"
#include "rollwave/study/study_table.h"
#include "rollwave/verify/reference_solution.h"
#include "rollwave/verify/true_errors.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <ostream>

namespace rollwave {

namespace {

void run_and_report_study(Study& study, const Parameters& parameters, MPI_Comm communicator,
                          std::ostream& out) {
  out << version_text() << "\n\n";
  run_study(study, parameters, out, communicator);
  if (process_number(communicator) == 0) {
    out << '\n' << table_as_text(study);
    print_study_notes(out, study);
    report_files(out, write_study(parameters, study));
  }
  if (!study.shortfall.empty())
    throw NotSolved(study.shortfall);
  if (std::none_of(study.runs.begin(), study.runs.end(),
                   [](const auto& run) { return run->is_solved(); }))
    throw NotSolved("no run of the study was solved; the first: " + study.runs.front()->failure);
}

/// Adds the errors to the result, where the exact solution is known.
void verify(Solution& solution, std::ostream& out) {
  const Scene& scene = solution.scene;
  const RunStatistics::Phase phase(solution.result.statistics, "verification");
  std::string why;
  if (const auto exact = find_exact_solution(scene, &why)) {
    solution.result.errors = measure_true_errors(solution, *exact);
    if (scene.load)
      solution.result.errors->exact_distance = find_exact_distance(scene);
    report_verification(out, scene, solution.result, *exact, find_exact_stiffness(scene));
  } else {
    solution.result.remarks.push_back("no exact solution is known for this scene: " + why);
    out << "\nNote: " << solution.result.remarks.back() << '\n';
  }
}

void solve_scene(const Scene& scene, const Parameters& parameters, MPI_Comm communicator,
                 bool verifies, std::ostream& out) {
  report_scene(out, scene, parameters);
  if (parameters.study.true_errors)
    out << "Note: Study/True errors does nothing without Study/Vary or Study/Scenes; --verify "
           "compares a single scene with its exact solution\n";
  Solution solution = simulate(scene, parameters, communicator, report_progress(out, scene));
  report_result(out, solution.result, scene.units);
  const auto& directory = parameters.output.directory;
  const WrittenFiles written = write_results(directory, parameters, solution);
  if (verifies) { // which may take long
    attempt([&] { verify(solution, out); }, "the result could not be verified",
            "leave out --verify", communicator, solution.result.shortfalls);
    WrittenFiles again;
    write_summary(directory, parameters, solution, again);
  }
  report_end(out, solution.result.statistics, written);
  if (!solution.result.shortfalls.empty())
    throw TargetNotReached(shortfall_text(solution.result));
}

} // namespace

void run_program(const CommandLine& line, MPI_Comm communicator, std::ostream& out) {
  Parameters parameters = read_parameters(settings_of(line, communicator));
  parameters.file = line.file;
  const bool is_study = !parameters.study.vary.empty() || !parameters.study.scenes.empty();
  if (is_study && line.verify)
    throw BadInput("--verify is for a single scene; a study has Study/True errors = true");
  try {
    Study study;
    Scene scene; // the runs of a study have their own
    if (is_study)
      study = plan_study(parameters, communicator);
    else
      scene = make_scene(parameters);
    const auto removed = prepare_directory(parameters, is_study, communicator);
    if (!removed.empty())
      out << "Note: files of an earlier run are removed: " << boost::algorithm::join(removed, ", ")
          << '\n';
    const auto& settings = parameters.settings;
    if (std::all_of(settings.begin(), settings.end(),
                    [](const Setting& setting) { return setting.section == "Output"; }))
      out << "Note: " << line.file.string() << " sets no parameter; solving the default scene\n";
    if (is_study)
      run_and_report_study(study, parameters, communicator, out);
    else
      solve_scene(scene, parameters, communicator, line.verify, out);
  } catch (const BadValue& value) {
    throw BadInput(refusal(parameters.settings, value));
  }
}

} // namespace rollwave
