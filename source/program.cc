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

/// The last line of a call that makes a part of a study, with the call that joins the parts.
void report_part(std::ostream& out, const Study& study, unsigned int n_made,
                 const std::string& program, const std::filesystem::path& directory) {
  out << "\nPart " << study.part->number << " of " << study.part->count << ": ";
  if (study.wanted_runs().empty())
    out << "no runs, since the study has " << study.plans.size();
  else
    out << n_made << " runs made, " << study.n_ended() - n_made << " reused";
  out << ". When all parts have ended, join them with: " << program << ' '
      << directory / "parameters.prm" << std::endl;
}

void run_and_report_study(Study& study, const Parameters& parameters,
                          const std::vector<std::filesystem::path>& older,
                          const std::string& program, MPI_Comm communicator, std::ostream& out) {
  out << version_text() << "\n\n";
  const unsigned int n_made = run_study(study, parameters, out, communicator);
  if (study.part)
    report_part(out, study, n_made, program, parameters.output.directory);
  else if (process_number(communicator) == 0) {
    const std::string text = study_text(study);
    out << '\n' << text;
    report_files(out, write_study(parameters, study, text, older));
  }
  if (!study.shortfall.empty())
    throw NotSolved(study.shortfall);
  const auto wanted = study.wanted_runs();
  if (!wanted.empty() && std::none_of(wanted.begin(), wanted.end(), [&](unsigned int run) {
        return study.runs[run]->is_solved();
      }))
    throw NotSolved("no run of the study was solved; the first: " +
                    study.runs[wanted.front()]->failure);
}

/// Adds the errors to the result, where the exact solution is known.
void verify(Solution& solution, MPI_Comm communicator, std::ostream& out) {
  const Scene& scene = solution.scene;
  const RunStatistics::Phase phase(solution.result.statistics, "verification");
  std::string why;
  if (const auto exact = find_exact_solution(scene, &why, communicator)) {
    solution.result.errors = measure_true_errors(solution, *exact);
    if (!scene.has_distance())
      solution.result.errors->exact_distance = find_exact_distance(scene, communicator);
    report_verification(out, scene, solution.result, *exact,
                        find_exact_stiffness(scene, communicator));
    for (Note& note : contradicted_guarantees(solution.result, *exact, scene.units)) {
      out << "Shortfall  " << note.text << '\n';
      solution.result.notes.push_back(std::move(note));
    }
  } else {
    const std::string remark = "no exact solution is known for this scene: " + why;
    solution.result.notes.push_back({Note::Kind::remark, remark});
    out << "\nNote: " << remark << '\n';
  }
}

void solve_scene(const Scene& scene, const Parameters& parameters,
                 const std::vector<std::filesystem::path>& older, MPI_Comm communicator,
                 bool verifies, std::ostream& out) {
  report_scene(out, scene, parameters);
  if (parameters.study.true_errors)
    out << "Note: Study/True errors does nothing without Study/Vary or Study/Scenes; --verify "
           "compares a single scene with its exact solution\n";
  Solution solution = simulate(scene, parameters, communicator, report_progress(out, scene));
  report_result(out, solution.result, solution.scene.units);
  const auto& directory = parameters.output.directory;
  WrittenFiles written = write_results(directory, parameters, solution);
  if (verifies) { // which may take long
    attempt([&] { verify(solution, communicator, out); }, "the result could not be verified",
            "leave out --verify", communicator, solution.result.notes);
    WrittenFiles again;
    write_summary(directory, parameters, solution, again);
  }
  written.note_older_files(older);
  report_end(out, solution.result.statistics, written);
  if (const std::string missed = shortfall_text(solution.result); !missed.empty())
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
    const auto older = prepare_directory(
        parameters, is_study ? study_file_names(parameters) : result_file_names(parameters.output),
        communicator);
    const auto& settings = parameters.settings;
    if (std::all_of(settings.begin(), settings.end(),
                    [](const Setting& setting) { return setting.section == "Output"; }))
      out << "Note: " << line.file.string() << " sets no parameter; solving the default scene\n";
    if (is_study)
      run_and_report_study(study, parameters, older, line.program, communicator, out);
    else
      solve_scene(scene, parameters, older, communicator, line.verify, out);
  } catch (const BadValue& value) {
    throw BadInput(refusal(parameters.settings, value));
  }
}

} // namespace rollwave
