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

#include <ostream>

namespace rollwave {

namespace fs = std::filesystem;

namespace {

/// Takes over the runs that an earlier call has solved.
void take_over(Study& study, const Parameters& parameters, MPI_Comm communicator) {
  const bool goes_on = process_number(communicator) == 0 && is_of_same_run(parameters);
  const auto read = [&](const char* name) {
    const fs::path file = fs::path(parameters.output.directory) / name;
    return broadcast(communicator, goes_on ? read_file(file) : "");
  };
  read_csv(read("study.csv"), study);
  read_profiles(read("study-profiles.csv"), study);
}

/// Writes the runs that have ended in their order.
void write_tables(const Study& study, const fs::path& directory) {
  std::string rows = csv_header(study), profiles = profiles_header(study);
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    if (study.runs[run]) {
      rows += csv_row(study, run);
      profiles += profile_rows(study, run);
    }
  write_file(directory / "study-profiles.csv", profiles);
  write_file(directory / "study.csv", rows);
}

/// Makes the runs that are missing. False when the user has interrupted it.
bool make_runs(Study& study, const Parameters& parameters, const fs::path& directory,
               std::ostream& out, MPI_Comm communicator) {
  const bool is_first = process_number(communicator) == 0;
  const dealii::Timer timer;
  unsigned int n_made = 0;
  try {
    StudySolver solver(study.plans, parameters, directory, report_long_runs(out), communicator);
    for (unsigned int run = 0; run < study.runs.size(); ++run) {
      if (study.runs[run])
        continue;
      study.runs[run] = solver.solve(run);
      if (is_first) {
        append_to_file(directory / "study-profiles.csv", profile_rows(study, run));
        append_to_file(directory / "study.csv", csv_row(study, run));
      }
      out << line_of_run(study, run);
      ++n_made;
      const auto n_missing = study.runs.size() - study.n_ended();
      constexpr unsigned int enough = 3; // to estimate the time of the others
      if (n_made >= enough && n_missing > 0)
        out << ", about " << rounded(timer.wall_time() / n_made * n_missing, 2) << " s left";
      out << std::endl;
    }
  } catch (const Interrupted&) {
    return false;
  }
  return true;
}

} // namespace

Study plan_study(const Parameters& parameters) {
  Study study;
  study.plans = plan_runs(parameters);
  study.runs.resize(study.plans.size());
  unsigned int n_keys = 0;
  for (const Variation& variation : parameters.study.vary) {
    study.first_key_of_part.push_back(n_keys);
    n_keys += variation.front().size();
  }
  return study;
}

void run_study(Study& study, const Parameters& parameters, std::ostream& out,
               MPI_Comm communicator) {
  const fs::path directory = parameters.output.directory;
  const bool is_first = process_number(communicator) == 0;
  take_over(study, parameters, communicator);
  const auto n_earlier = study.n_ended();
  if (n_earlier > 0)
    out << n_earlier << " of " << study.runs.size() << " runs are reused from study.csv\n";
  if (is_first) {
    write_tables(study, directory); // before parameters.prm, which marks them as this study's
    WrittenFiles written;
    write_parameters(directory, parameters, written);
  }
  const bool is_complete = make_runs(study, parameters, directory, out, communicator);
  if (is_first && n_earlier > 0)
    write_tables(study, directory); // in the order of the study
  if (!is_complete) {
    if (study.n_ended() == 0)
      throw Interrupted("interrupted before the first run was made");
    study.shortfall = "interrupted after " + std::to_string(study.n_ended()) + " of " +
                      std::to_string(study.runs.size()) +
                      " runs; rerun the same command to continue";
  }
}

} // namespace rollwave
