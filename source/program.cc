#include "rollwave/program.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/version.h"
#include "rollwave/output/output_directory.h"
#include "rollwave/output/screen_report.h"
#include "rollwave/output/verification_report.h"
#include "rollwave/parameters/parameters.h"
#include "rollwave/run/simulation.h"
#include "rollwave/study/study_files.h"
#include "rollwave/study/study_runner.h"
#include "rollwave/study/study_table.h"
#include "rollwave/verify/reference_solution.h"
#include "rollwave/verify/true_errors.h"

#include <algorithm>
#include <filesystem>
#include <ostream>

namespace rollwave {

namespace {

void make_study(const Parameters& parameters, const Processes& processes, std::ostream& out) {
  out << version_text() << "\n\n";
  const std::filesystem::path directory = parameters.output.directory;
  const Study study = run_study(parameters, directory, out, processes.communicator());
  if (processes.is_first()) {
    print_study_notes(out, study);
    report_files(out, write_study(directory, parameters, study));
  }
  processes.wait_for_first();
  if (!study.shortfall.empty())
    throw NotSolved(study.shortfall);
  if (processes.is_first() && std::none_of(study.runs.begin(), study.runs.end(),
                                           [](const auto& run) { return run->is_solved(); }))
    throw NotSolved("no run of the study was solved; the first: " + study.runs.front()->failure);
}

/// Adds the errors to the result, where the exact solution is known.
void verify(Solution& solution, std::ostream& out) {
  const Scene& scene = solution.scene;
  if (const auto exact = find_exact_solution(scene)) {
    solution.result.errors = measure_true_errors(*solution.space, solution.displacement,
                                                 solution.result, solution.certificate, *exact);
    if (scene.load)
      solution.result.errors->exact_distance = find_exact_distance(scene);
    report_verification(out, scene, solution.result, *exact);
  } else
    out << "\nNo exact solution is known for this scene: its force is not constant, its "
           "zone cuts the contact short unevenly, or the contact is too long beside the "
           "thickness of the ring.\n";
}

void solve_scene(const Parameters& parameters, const Processes& processes, bool verifies,
                 std::ostream& out) {
  const Scene scene = make_scene(parameters);
  const auto directory = prepare_directory(parameters, processes.communicator());
  report_scene(out, scene, parameters);
  if (parameters.study.true_errors)
    out << "Note: Study/True errors does nothing without Study/Vary or Study/Scenes; --verify "
           "compares a single scene with its exact solution\n";
  Solution solution = simulate(scene, parameters, processes.communicator());
  report_result(out, to_lengths(solution.result, scene.unit));
  if (verifies)
    verify(solution, out);
  const WrittenFiles written = write_results(directory, solution.scene, parameters, solution);
  report_end(out, solution.result.work, written);
  processes.wait_for_first();
  if (!solution.result.shortfalls.empty())
    throw NotSolved(shortfall_text(solution.result));
}

} // namespace

void run_program(const CommandLine& line, const Processes& processes, std::ostream& out) {
  const Parameters parameters = read_parameters(settings_of(line));
  const bool is_study = !parameters.study.vary.empty() || !parameters.study.scenes.empty();
  if (is_study && line.verify)
    throw BadInput("--verify is for a single scene; a study has Study/True errors = true");
  try {
    if (is_study)
      make_study(parameters, processes, out);
    else
      solve_scene(parameters, processes, line.verify, out);
  } catch (const BadValue& value) {
    throw BadInput(refusal(parameters.settings, value));
  }
}

} // namespace rollwave
