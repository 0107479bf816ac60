#include "rollwave/study/study_runner.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/text.h"
#include "rollwave/output/output_directory.h"
#include "rollwave/output/progress_report.h"
#include "rollwave/study/run_digest.h"
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

/// A table of a study: that of the whole study or of its part, to which rows are added.
struct Table {
  fs::path path;
  std::string header;

  Table(const fs::path& directory, std::string name, const Study& study, std::string header)
      : header(std::move(header)) {
    if (study.part)
      name += ".part-" + std::to_string(study.part->number) + "-of-" +
              std::to_string(study.part->count);
    path = directory / (name + ".csv");
  }

  void append(const std::string& rows) const {
    std::error_code ignored;
    const bool is_new = !fs::exists(path, ignored) || fs::is_empty(path, ignored);
    append_to_file(path, (is_new ? header : "") + rows);
  }

  /// After a stop within a row, the next one begins a line.
  void end_last_line() const {
    if (const std::string text = read_file(path); !text.empty() && text.back() != '\n')
      append_to_file(path, "\n");
  }
};

struct Tables {
  Table rows, profiles;

  Tables(const fs::path& directory, const Study& study)
      : rows(directory, rows_name, study, csv_header(study)),
        profiles(directory, profiles_name, study, profiles_header(study)) {}
};

/// The rows of the runs that have ended, in their order.
std::string all_rows(const Study& study) {
  std::string rows;
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    if (study.runs[run])
      rows += csv_row(study, run);
  return rows;
}

void write_tables(const Study& study, const Tables& tables) {
  std::string profiles = tables.profiles.header;
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    if (study.runs[run])
      profiles += profile_rows(study, run);
  write_file(tables.profiles.path, profiles);
  write_file(tables.rows.path, tables.rows.header + all_rows(study));
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

/// True if a run needs no files of its own, or all of them are there.
bool has_own_files(const Study& study, unsigned int run, const Parameters& parameters) {
  const fs::path directory = directory_of_run(run);
  return parameters.study.files_of_each_run.empty() ||
         (study.runs[run]->files == directory &&
          read_file(parameters.output.directory / directory / "parameters.prm")
                  .find(digest_of_files(study.plans[run].digest, parameters)) != std::string::npos);
}

/// Takes over the runs that earlier calls have solved.
void take_over(Study& study, const Parameters& parameters, MPI_Comm communicator) {
  const fs::path directory = parameters.output.directory;
  const bool is_first = process_number(communicator) == 0;
  if (is_first) {
    read_csv(read_tables(directory, rows_name), study);
    read_profiles(read_tables(directory, profiles_name), study);
    for (unsigned int run = 0; run < study.runs.size(); ++run)
      if (study.runs[run] && !has_own_files(study, run, parameters))
        study.runs[run].reset();
  }
  const std::string rows = broadcast(communicator, is_first ? all_rows(study) : "");
  if (!is_first)
    read_csv(rows, study);
}

/// Makes the runs that are missing, equal ones once, and counts them in @p n_made. False when the
/// user has interrupted it.
bool make_runs(Study& study, const Parameters& parameters, const Tables& tables, std::ostream& out,
               MPI_Comm communicator, unsigned int& n_made) {
  std::vector<unsigned int> missing;
  for (const unsigned int run : study.wanted_runs())
    if (!study.runs[run])
      missing.push_back(run);
  if (missing.empty())
    return true;
  const bool is_first = process_number(communicator) == 0;
  if (is_first) {
    tables.rows.end_last_line();
    tables.profiles.end_last_line();
  }
  const dealii::Timer timer;
  std::map<std::string, unsigned int> made; // by their digests
  try {
    StudySolver solver(study.plans, parameters, parameters.output.directory, report_long_runs(out),
                       communicator);
    for (unsigned int i = 0; i < missing.size(); ++i) {
      const unsigned int run = missing[i];
      const auto [equal, is_other] = made.emplace(study.plans[run].digest, run);
      if (is_other || !parameters.study.files_of_each_run.empty()) {
        study.runs[run] = solver.solve(run);
        if (is_first) {
          tables.profiles.append(profile_rows(study, run));
          tables.rows.append(csv_row(study, run));
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
  study.settings = read_parameters(settings_of_run(parameters, study.plans.front())).settings;
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
  take_over(study, parameters, communicator);
  if (const auto n_earlier = study.n_ended(); n_earlier > 0)
    out << n_earlier << " of " << n_wanted << " runs are reused\n";
  const Tables tables(directory, study);
  unsigned int n_made = 0;
  const bool is_complete = make_runs(study, parameters, tables, out, communicator, n_made);
  const auto n_ended = study.n_ended();
  if (is_first && n_ended > 0)
    write_tables(study, tables);
  if (!is_complete) {
    if (n_ended == 0)
      throw Interrupted("interrupted before the first run was made");
    study.shortfall = "interrupted after " + std::to_string(n_ended) + " of " +
                      std::to_string(n_wanted) + " runs; rerun the same command to continue";
  }
  return n_made;
}

} // namespace rollwave
