#include "rollwave/study/study_runner.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/text.h"
#include "rollwave/output/output_directory.h"
#include "rollwave/output/progress_report.h"
#include "rollwave/study/study_csv.h"
#include "rollwave/study/study_solver.h"
#include "rollwave/study/study_table.h"

#include <deal.II/base/timer.h>

#include <algorithm>
#include <map>
#include <ostream>

namespace rollwave {

namespace fs = std::filesystem;

namespace {

const std::string rows_name = "study", profiles_name = "study-profiles"; ///< of the tables

/// The path of a table of a study, or of its part.
fs::path table_path(const fs::path& directory, std::string name, const Study& study) {
  if (study.part)
    name +=
        ".part-" + std::to_string(study.part->number) + "-of-" + std::to_string(study.part->count);
  return directory / (name + ".csv");
}

/// Adds rows to a table, which may be removed while the study runs. After a stop within a row they
/// begin in its line, which read_csv() and read_profiles() allow for.
void append(const fs::path& table, const std::string& header, const std::string& rows) {
  std::error_code ignored;
  const bool is_new = !fs::exists(table, ignored) || fs::is_empty(table, ignored);
  append_to_file(table, (is_new ? header : "") + rows);
}

/// The rows of the runs that have ended, in their order.
std::string all_rows(const Study& study, std::string (*rows_of)(const Study&, unsigned int run)) {
  std::string rows;
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    if (study.runs[run])
      rows += rows_of(study, run);
  return rows;
}

/// The texts of the tables that all parts and the whole study have under a name.
std::string read_tables(const fs::path& directory, const std::string& name) {
  std::string text;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(directory, ignored))
    if (const std::string file = entry.path().filename().string();
        is_table_of_part(file) && file.rfind(name + '.', 0) == 0)
      text += read_file(entry.path()) + '\n';
  return text + read_file(directory / (name + ".csv"));
}

/// Takes over the runs that earlier calls have solved, if the directories of their files are there.
void take_over(Study& study, const fs::path& directory, MPI_Comm communicator) {
  const bool is_first = process_number(communicator) == 0;
  if (is_first) {
    read_csv(read_tables(directory, rows_name), study);
    read_profiles(read_tables(directory, profiles_name), study);
    for (auto& run : study.runs)
      if (run && !run->files.empty() && !fs::exists(directory / run->files))
        run.reset();
  }
  const std::string rows = broadcast(communicator, is_first ? all_rows(study, csv_row) : "");
  if (!is_first)
    read_csv(rows, study);
}

/// Makes the runs that are missing, equal ones once, and counts them in @p n_made. False when the
/// user has interrupted it.
bool make_runs(Study& study, const Parameters& parameters, std::ostream& out, MPI_Comm communicator,
               unsigned int& n_made) {
  const fs::path directory = parameters.output.directory;
  std::vector<unsigned int> missing;
  for (const unsigned int run : study.wanted_runs())
    if (!study.runs[run])
      missing.push_back(run);
  if (missing.empty())
    return true;
  const dealii::Timer timer;
  std::map<std::string, unsigned int> made; // by their digests
  try {
    StudySolver solver(study.plans, parameters, directory, report_long_runs(out), communicator);
    for (unsigned int i = 0; i < missing.size(); ++i) {
      const unsigned int run = missing[i];
      const auto [equal, is_other] = made.emplace(study.plans[run].digest, run);
      if (is_other) {
        study.runs[run] = solver.solve(run);
        if (process_number(communicator) == 0) {
          append(table_path(directory, profiles_name, study), profiles_header(study),
                 profile_rows(study, run));
          append(table_path(directory, rows_name, study), csv_header(study), csv_row(study, run));
        }
        ++n_made;
      } else
        study.runs[run] = study.runs[equal->second];
      out << line_of_run(study, run);
      const auto n_missing = missing.size() - i - 1;
      constexpr unsigned int enough = 3; // to estimate the time of the others
      if (n_made >= enough && n_missing > 0)
        out << ", about " << rounded(timer.wall_time() / (i + 1) * n_missing, 2) << " s left";
      out << std::endl;
    }
  } catch (const Interrupted&) {
    return false;
  }
  return true;
}

} // namespace

bool is_table_of_part(const std::string& name) {
  return fs::path(name).extension() == ".csv" &&
         (name.rfind(rows_name + ".part-", 0) == 0 || name.rfind(profiles_name + ".part-", 0) == 0);
}

Study plan_study(const Parameters& parameters, const std::optional<StudyPart>& part) {
  Study study;
  study.plans = plan_runs(parameters);
  study.runs.resize(study.plans.size());
  if (part && part->count > study.plans.size())
    throw BadInput("--part: the study has " + std::to_string(study.plans.size()) +
                   " runs, which cannot be divided into " + std::to_string(part->count) + " parts");
  study.part = part;
  unsigned int n_keys = 0;
  for (const Variation& variation : parameters.study.vary) {
    study.first_key_of_part.push_back(n_keys);
    n_keys += variation.front().size();
  }
  return study;
}

unsigned int run_study(Study& study, const Parameters& parameters, std::ostream& out,
                       MPI_Comm communicator) {
  const fs::path directory = parameters.output.directory;
  const bool is_first = process_number(communicator) == 0;
  const auto n_wanted = study.wanted_runs().size();
  if (is_first) {
    if (!parameters.study.files_of_each_run.empty())
      for (const unsigned int run : study.wanted_runs())
        check_own_files(directory / directory_of_run(run), parameters,
                        parameters.study.files_of_each_run);
    WrittenFiles written;
    write_parameters(directory, parameters, written);
    for (const std::string& remark : written.remarks)
      out << "Note: " << remark << '\n';
  }
  take_over(study, directory, communicator);
  if (const auto n_earlier = study.n_ended(); n_earlier > 0)
    out << n_earlier << " of " << n_wanted << " runs are reused\n";
  unsigned int n_made = 0;
  const bool is_complete = make_runs(study, parameters, out, communicator, n_made);
  const auto n_ended = study.n_ended();
  if (is_first && n_ended > 0) {
    write_file(table_path(directory, profiles_name, study),
               profiles_header(study) + all_rows(study, profile_rows));
    write_file(table_path(directory, rows_name, study),
               csv_header(study) + all_rows(study, csv_row));
  }
  if (!is_complete) {
    if (n_ended == 0)
      throw Interrupted("interrupted before the first run was made");
    study.shortfall = "interrupted after " + std::to_string(n_ended) + " of " +
                      std::to_string(n_wanted) + " runs; rerun the same command to continue";
  }
  return n_made;
}

} // namespace rollwave
