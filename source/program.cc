#include "rollwave/program.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/version.h"
#include "rollwave/output/output_directory.h"
#include "rollwave/output/progress_report.h"
#include "rollwave/output/result_files.h"
#include "rollwave/output/screen_report.h"
#include "rollwave/parameters/parameters.h"
#include "rollwave/run/attempt.h"
#include "rollwave/run/simulation.h"
#include "rollwave/study/study_files.h"
#include "rollwave/study/study_runner.h"
#include "rollwave/study/study_table.h"
#include "rollwave/verify/reference_solution.h"
#include "rollwave/verify/true_errors.h"
#include "rollwave/verify/verification_report.h"

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace rollwave {

namespace {

/// One call of the program: what was asked for, and where its results go.
struct Call {
  const CommandLine& line;
  const Parameters& parameters;
  std::vector<std::filesystem::path> older_files; ///< in the output directory
  MPI_Comm communicator;
  std::ostream& out;
};

/// The last line of a call that makes a part of a study.
void report_part(const Call& call, const Study& study, unsigned int n_made) {
  call.out << "\nPart " << study.part->number << " of " << study.part->count << ": ";
  if (study.wanted_runs().empty())
    call.out << "no runs, since the study has " << study.plans.size();
  else
    call.out << n_made << " runs made, " << study.n_ended() - n_made << " reused";
  call.out << ". When all parts have ended, the same command without --part joins them."
           << std::endl;
}

void run_and_report_study(const Call& call, Study& study) {
  call.out << version_text() << "\n\n";
  const unsigned int n_made = run_study(study, call.parameters, call.out, call.communicator);
  if (study.part)
    report_part(call, study, n_made);
  else if (process_number(call.communicator) == 0) {
    const std::string text = study_text(study);
    call.out << '\n' << text;
    report_files(call.out, write_study(call.parameters, study, text, call.older_files));
  }
  if (!study.shortfall.empty())
    throw NotSolved(study.shortfall);
  const auto wanted = study.wanted_runs();
  if (!wanted.empty() && std::none_of(wanted.begin(), wanted.end(), [&](unsigned int run) {
        return study.runs[run]->is_solved();
      }))
    throw NotSolved("no run of the study was solved; the first: " +
                    shortfall_text(study.runs[wanted.front()]->notes));
}

/// Adds the errors to the result, where the exact solution is known.
void verify(const Call& call, Solution& solution) {
  const Scene& scene = solution.scene;
  const RunStatistics::Phase phase(solution.result.statistics, "verification");
  std::string why;
  if (const auto exact = find_exact_solution(scene, &why, call.communicator)) {
    solution.result.errors = measure_true_errors(solution, *exact);
    if (!scene.has_distance())
      solution.result.errors->exact_distance = find_exact_distance(scene, call.communicator);
    report_verification(call.out, scene, solution.result, *exact,
                        find_exact_stiffness(scene, call.communicator));
    for (Note& note : contradicted_guarantees(solution.result, *exact, scene.units)) {
      call.out << "Shortfall  " << note.text << '\n';
      solution.result.notes.push_back(std::move(note));
    }
  } else {
    const std::string remark = "no exact solution is known for this scene: " + why;
    solution.result.notes.push_back({Note::Kind::remark, remark});
    call.out << "\nNote: " << remark << '\n';
  }
}

void solve_scene(const Call& call, const Scene& scene) {
  report_scene(call.out, scene, call.parameters);
  const StudyOptions& study = call.parameters.study;
  if (study.true_errors || !study.files_of_each_run.empty() || !study.published_steps.empty())
    call.out
        << "Note: section Study does nothing without Vary or Scenes; --verify compares a single "
           "scene with its exact solution\n";
  Solution solution =
      simulate(scene, call.parameters, call.communicator, report_progress(call.out, scene));
  report_result(call.out, solution.result, solution.scene.units);
  const auto& directory = call.parameters.output.directory;
  WrittenFiles written = write_results(directory, call.parameters, solution);
  if (call.line.verify) { // which may take long
    attempt([&] { verify(call, solution); }, "the result could not be verified",
            "leave out --verify", call.communicator, solution.result.notes);
    WrittenFiles again;
    write_summary(directory, call.parameters, solution, again);
  }
  written.note_older_files(call.older_files);
  report_end(call.out, solution.result.statistics, written);
  if (const std::string missed = shortfall_text(solution.result.notes); !missed.empty())
    throw TargetNotReached(missed);
}

} // namespace

void run_program(const CommandLine& line, MPI_Comm communicator, std::ostream& out) {
  Parameters parameters = read_parameters(settings_of(line, communicator));
  parameters.file = line.file;
  const bool is_study = !parameters.study.vary.empty() || !parameters.study.scenes.empty();
  if (is_study && line.verify)
    throw BadInput("--verify is for a single scene; a study has Study/True errors = true");
  if (!is_study && line.part)
    throw BadInput("--part is for a study; this file has neither Study/Vary nor Study/Scenes");
  try {
    Study study;
    Scene scene; // the runs of a study have their own
    if (is_study)
      study = plan_study(parameters, line.part);
    else
      scene = make_scene(parameters);
    const auto names =
        is_study ? study_file_names(parameters) : result_file_names(parameters.output);
    const Call call = {line, parameters, prepare_directory(parameters, names, communicator),
                       communicator, out};
    const auto& settings = parameters.settings;
    if (std::all_of(settings.begin(), settings.end(),
                    [](const Setting& setting) { return setting.section == "Output"; }))
      out << "Note: " << line.file.string() << " sets no parameter; solving the default scene\n";
    if (is_study)
      run_and_report_study(call, study);
    else
      solve_scene(call, scene);
  } catch (const BadValue& value) {
    throw BadInput(refusal(parameters.settings, value));
  }
}

} // namespace rollwave
