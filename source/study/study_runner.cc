#include "rollwave/study/study_runner.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/interrupt.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/output/output_directory.h"
#include "rollwave/study/study_bench.h"
#include "rollwave/study/study_table.h"

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <optional>
#include <ostream>
#include <set>
#include <sstream>
#include <utility>

namespace rollwave {

namespace {

namespace fs = std::filesystem;

/// Whether a run has no need to be made again.
bool is_final(const StudyRun& run, const Parameters& study, const fs::path& directory) {
  if (!run.failure.empty() && !run.is_refused)
    return false;
  if (run.is_refused)
    return true;
  const auto has = [&](const char* name) { return fs::exists(directory / run.files / name); };
  const auto& kinds = study.study.files_of_each_run;
  return std::all_of(kinds.begin(), kinds.end(), [&](OutputFile kind) {
    return !run.files.empty() &&
           (kind == OutputFile::plot || (kind == OutputFile::summary && has("summary.json")) ||
            (kind == OutputFile::contact && has("contact.csv")) ||
            (kind == OutputFile::parameters && has("parameters.prm")) ||
            (kind == OutputFile::surface && has("surface.vtu")) ||
            (kind == OutputFile::solution && (has("solution.vtu") || has("solution.pvtu"))));
  });
}

/// Of an earlier call the lines of runs that need not be made again; a table with other runs is set
/// aside.
std::string earlier_runs(const Parameters& parameters, const fs::path& directory,
                         const std::vector<RunPlan>& plans, std::ostream& out) {
  std::ostringstream text;
  text << std::ifstream(directory / "study.jsonl").rdbuf();
  const auto runs = read_study_runs(text.str());
  std::map<std::map<std::string, std::string>, const RunPlan*> plan_of;
  for (const RunPlan& plan : plans)
    plan_of[plan.identity] = &plan;
  std::string kept;
  bool has_others = runs.empty() && fs::exists(directory / "study.csv");
  for (const auto& [identity, run] : runs)
    if (const auto plan = plan_of.find(identity); plan == plan_of.end())
      has_others = true;
    else if (is_final(run, parameters, directory))
      kept += study_line(*plan->second, run) + '\n';
  if (has_others)
    out << "Note: study.csv has rows of other runs, and is kept as " << set_study_aside(directory)
        << ".csv\n";
  return kept;
}

void adopt(const std::string& earlier, Study& study) {
  const auto runs = read_study_runs(earlier);
  const std::map<std::map<std::string, std::string>, StudyRun> run_of(runs.begin(), runs.end());
  for (unsigned int i = 0; i < study.plans.size(); ++i)
    if (const auto run = run_of.find(study.plans[i].identity); run != run_of.end())
      study.runs[i] = run->second;
}

/// The directories of the files of runs that are to be made: run-001 and so on, without those that
/// earlier runs have.
std::vector<std::string> choose_directories(const Study& study) {
  std::set<std::string> taken;
  for (const auto& run : study.runs)
    if (run)
      taken.insert(run->files);
  std::vector<std::string> directories(study.runs.size());
  unsigned int number = 0;
  for (unsigned int i = 0; i < study.runs.size(); ++i)
    if (!study.runs[i])
      do
        directories[i] = "run-" + dealii::Utilities::int_to_string(++number, 3);
      while (taken.count(directories[i]) > 0);
  return directories;
}

void write_runs(const fs::path& directory, const Study& study) {
  std::string lines;
  for (unsigned int i = 0; i < study.runs.size(); ++i)
    if (study.runs[i])
      lines += study_line(study.plans[i], *study.runs[i]) + '\n';
  write_file(directory / "study.jsonl", lines);
  write_file(directory / "study.csv", study_csv(study));
}

/// Makes the runs of these numbers and hands each to @p add. False when the user has interrupted
/// it.
bool make_runs(const Study& study, const std::vector<unsigned int>& numbers,
               const std::vector<std::string>& directories, const Parameters& parameters,
               const fs::path& directory, MPI_Comm communicator,
               const std::function<void(unsigned int, StudyRun)>& add) {
  StudyBench bench(study.plans, parameters, directory, communicator);
  try {
    for (const unsigned int number : numbers)
      add(number, bench.make(study.plans[number], directories[number]));
  } catch (const Interrupted&) {
    return false;
  }
  return true;
}

} // namespace

Study plan_study(const Parameters& parameters, MPI_Comm communicator) {
  Study study;
  study.plans = plan_runs(parameters, count_processes(communicator));
  study.runs.resize(study.plans.size());
  study.has_true_errors = parameters.study.true_errors;
  unsigned int place = 0;
  for (const Variation& variation : parameters.study.vary) {
    study.first_keys.push_back(place);
    place += variation.front().size();
  }
  return study;
}

void run_study(Study& study, const Parameters& parameters, const fs::path& directory,
               std::ostream& out, MPI_Comm communicator) {
  const bool is_first = process_number(communicator) == 0;
  adopt(share_text(communicator, is_first ? earlier_runs(parameters, directory, study.plans, out)
                                          : std::string()),
        study);
  if (is_first && !is_input(parameters, directory / "parameters.prm")) {
    std::ostringstream text;
    write_parameters(text, parameters);
    write_file(directory / "parameters.prm", text.str());
  }
  const StudyTable table(study);
  const auto directories = parameters.study.files_of_each_run.empty()
                               ? std::vector<std::string>(study.runs.size())
                               : choose_directories(study);
  std::vector<unsigned int> numbers;
  out << table.header();
  for (unsigned int i = 0; i < study.runs.size(); ++i)
    if (study.runs[i])
      out << table.row(i, "done before");
    else
      numbers.push_back(i);
  out << std::flush;
  const auto add = [&](unsigned int number, StudyRun run) {
    study.runs[number] = std::move(run);
    out << table.row(number) << std::flush;
    if (is_first)
      write_runs(directory, study);
  };
  if (is_first && numbers.size() < study.runs.size())
    write_runs(directory, study);
  if (!make_runs(study, numbers, directories, parameters, directory, communicator, add)) {
    const auto n_made = std::count_if(study.runs.begin(), study.runs.end(),
                                      [](const auto& run) { return run.has_value(); });
    if (n_made == 0)
      throw Interrupted("interrupted before the first run was made");
    study.shortfall = "interrupted after " + std::to_string(n_made) + " of " +
                      std::to_string(study.runs.size()) +
                      " runs; the same command goes on with the others";
  }
}

} // namespace rollwave
