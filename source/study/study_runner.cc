#include "rollwave/study/study_runner.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/text.h"
#include "rollwave/output/output_directory.h"
#include "rollwave/output/progress_report.h"
#include "rollwave/study/study_solver.h"
#include "rollwave/study/study_table.h"

#include <deal.II/base/timer.h>

#include <filesystem>
#include <ostream>
#include <vector>

namespace rollwave {

namespace fs = std::filesystem;

namespace {

/// known_run(), which rank 0 reads for all.
std::optional<RunRecord> known_to_all(const fs::path& directory, const std::string& digest,
                                      const OwnFiles& wanted, MPI_Comm communicator) {
  std::optional<RunRecord> record;
  if (process_number(communicator) == 0)
    record = known_run(directory, digest, wanted);
  if (is_serial(communicator))
    return record;
  return from_json(broadcast(communicator, record ? to_json(*record, digest) : ""), digest);
}

/// Takes over the wanted runs that are known and not yet in the study.
void take_over(Study& study, const fs::path& directory, MPI_Comm communicator) {
  for (const unsigned int run : study.wanted_runs())
    if (!study.runs[run])
      study.runs[run] = known_to_all(directory, study.plans[run].digest, study.files, communicator);
}

/// The numbers of runs, as in "2, 5 to 7".
std::string list_of(const std::vector<unsigned int>& runs) {
  std::string text;
  for (std::size_t first = 0, last; first < runs.size(); first = last + 1) {
    for (last = first; last + 1 < runs.size() && runs[last + 1] == runs[last] + 1;)
      ++last;
    text += (text.empty() ? "" : ", ") + std::to_string(runs[first] + 1);
    if (last > first)
      text += (last > first + 1 ? " to " : ", ") + std::to_string(runs[last] + 1);
  }
  return text;
}

std::vector<unsigned int> missing_runs(const Study& study) {
  std::vector<unsigned int> missing;
  for (const unsigned int run : study.wanted_runs())
    if (!study.runs[run])
      missing.push_back(run);
  return missing;
}

/// Makes a run with the files that are wanted and those that an earlier call has made, and writes
/// its record. The record of an earlier call names no file while its files are replaced.
RunRecord make_run(const Study& study, unsigned int run, StudySolver& solver,
                   const Parameters& parameters, MPI_Comm communicator) {
  const fs::path directory = parameters.output.directory;
  const std::string& digest = study.plans[run].digest;
  const bool is_first = process_number(communicator) == 0;
  OwnFiles files = study.files;
  if (!files.kinds.empty())
    if (auto earlier = known_to_all(directory, digest, {}, communicator);
        earlier && !earlier->files.kinds.empty()) {
      auto kinds = files.kinds;
      kinds.merge(earlier->files.kinds);
      files = own_files(parameters, kinds);
      earlier->files = {};
      if (is_first)
        write_record(directory, digest, *earlier);
    }
  RunRecord record = solver.record_of(run, files);
  if (is_first && record.is_solved())
    write_record(directory, digest, record);
  return record;
}

/// Makes the runs that are missing and counts them in @p n_made. Another call may have made a run
/// in the meantime, and equal runs are made once. False when the user has interrupted it.
bool make_runs(Study& study, const Parameters& parameters, std::ostream& out, MPI_Comm communicator,
               unsigned int& n_made) {
  const fs::path directory = parameters.output.directory;
  const auto missing = missing_runs(study);
  const dealii::Timer timer;
  try {
    StudySolver solver(study.plans, parameters, report_long_runs(out), communicator);
    for (unsigned int i = 0; i < missing.size(); ++i) {
      const unsigned int run = missing[i];
      study.runs[run] = known_to_all(directory, study.plans[run].digest, study.files, communicator);
      if (!study.runs[run]) {
        study.runs[run] = make_run(study, run, solver, parameters, communicator);
        ++n_made;
      }
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

Study plan_study(const Parameters& parameters, const std::optional<StudyPart>& part) {
  Study study;
  study.plans = plan_runs(parameters);
  study.runs.resize(study.plans.size());
  study.files = own_files(parameters, parameters.study.files_of_each_run);
  study.part = part;
  unsigned int n_keys = 0;
  for (const Variation& variation : parameters.study.vary) {
    study.first_key_of_part.push_back(n_keys);
    n_keys += variation.front().size();
    study.n_fastest = variation.size();
  }
  return study;
}

unsigned int run_study(Study& study, const Parameters& parameters, std::ostream& out,
                       MPI_Comm communicator) {
  const fs::path directory = parameters.output.directory;
  const auto n_wanted = study.wanted_runs().size();
  if (process_number(communicator) == 0) {
    WrittenFiles written;
    write_parameters(directory, parameters, written);
    for (const Note& note : written.notes)
      out << "Note: " << note.text << '\n';
  }
  take_over(study, directory, communicator);
  if (const auto n_known = study.n_ended(); n_known > 0) {
    out << n_known << " of " << n_wanted << " runs are reused";
    if (n_known < n_wanted)
      out << "; to be made: " << list_of(missing_runs(study));
    out << '\n';
  }
  unsigned int n_made = 0;
  if (make_runs(study, parameters, out, communicator, n_made))
    return n_made;
  take_over(study, directory, communicator); // what other calls have made
  if (study.n_ended() == 0)
    throw Interrupted("interrupted before the first run was made");
  study.shortfall = "interrupted after " + std::to_string(study.n_ended()) + " of " +
                    std::to_string(n_wanted) + " runs; rerun the same command to continue";
  return n_made;
}

} // namespace rollwave
