#include "rollwave/study/study_runner.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/interrupt.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/task_farm.h"
#include "rollwave/output/output_directory.h"
#include "rollwave/run/simulation.h"
#include "rollwave/scene/scene.h"
#include "rollwave/study/study_bench.h"
#include "rollwave/study/study_plan.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <ostream>
#include <sstream>
#include <utility>

namespace rollwave {

namespace {

/// All parameters but how many processes make a run, which a study can be gone on with in another
/// number.
std::string parameters_text(Parameters parameters) {
  auto& settings = parameters.settings;
  settings.erase(std::remove_if(settings.begin(), settings.end(),
                                [](const Setting& setting) {
                                  return setting.path() == "Study/Processes per scene";
                                }),
                 settings.end());
  std::ostringstream text;
  write_parameters(text, parameters);
  return text.str();
}

std::string read_text(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// The study.csv of an earlier call of this study, empty when there is none; otherwise makes the
/// directory that of this study, and keeps the table of another one aside.
std::string claim_directory(const Parameters& parameters, const std::filesystem::path& directory,
                            std::ostream& progress) {
  const std::string own = parameters_text(parameters);
  if (own == read_text(directory / "parameters.prm"))
    return read_text(directory / "study.csv");
  if (is_input(parameters, directory / "parameters.prm"))
    throw BadInput(refusal(parameters.settings, "Output", "Directory",
                           "the parameters of the study would replace the file that was read; "
                           "choose another directory"));
  // In this order: rows beside the parameters of another study would be taken for its own.
  const auto table = directory / "study.csv", kept = directory / "study-before.csv";
  std::error_code error;
  if (std::filesystem::exists(table, error)) {
    std::filesystem::rename(table, kept, error);
    progress << "Note: study.csv is of other parameters, and kept as study-before.csv\n";
  }
  if (error)
    throw NotWritten(table.string() + " could not be moved: " + error.message());
  write_file(directory / "parameters.prm", own);
  return {};
}

/// Writes study.csv, and parameters.prm where the directory has been removed.
void write_runs(const Parameters& parameters, const std::filesystem::path& directory,
                const std::vector<StudyRun>& runs) {
  std::error_code ignored;
  if (!std::filesystem::exists(directory / "parameters.prm", ignored))
    write_file(directory / "parameters.prm", parameters_text(parameters));
  write_file(directory / "study.csv", study_csv(runs));
}

/// The rows of a study in their order, those of this call and of earlier ones.
class Rows {
public:
  Rows(const Parameters& parameters, const std::vector<RunPlan>& plans,
       const std::filesystem::path& directory, std::ostream& progress, bool writes)
      : parameters(parameters), plans(plans), directory(directory), progress(progress),
        writes(writes) {}

  void announce(const char* remark = "") const { announce(rows.size(), remark); }

  void announce(std::size_t number, const char* remark = "") const {
    const RunPlan& plan = plans[number];
    progress << "run " << number + 1 << " of " << plans.size() << ':';
    if (!plan.scene.empty())
      progress << "  " << plan.scene;
    for (const Setting& setting : plan.varied)
      progress << "  " << setting.path() << " = " << setting.value;
    progress << remark << std::endl;
  }

  /// Appends what has been found before.
  void adopt(StudyRun run) {
    const RunPlan& plan = plans[rows.size()];
    run.scene = plan.scene;
    run.settings = plan.varied;
    if (!parameters.study.published_steps.empty())
      run.published_steps = parameters.study.published_steps[rows.size()];
    rows.push_back(std::move(run));
  }

  /// Appends a run that has been made, and brings study.csv up to date.
  void add(StudyRun run) {
    if (!run.failure.empty())
      progress << "run " << rows.size() + 1 << " is not solved: " << run.failure << std::endl;
    adopt(std::move(run));
    if (writes)
      write_runs(parameters, directory, rows);
  }

  std::size_t size() const { return rows.size(); }

  /// The study as it is; where @p is_interrupted it lacks runs. @throws Interrupted without a row.
  Study end(bool is_interrupted) && {
    if (!is_interrupted)
      return {std::move(rows), ""};
    const std::string shortfall = "interrupted after " + std::to_string(rows.size()) + " of " +
                                  std::to_string(plans.size()) +
                                  " runs; the same command goes on with the others";
    if (rows.empty())
      throw Interrupted("interrupted before the first run was made");
    return {std::move(rows), shortfall};
  }

private:
  const Parameters& parameters;
  const std::vector<RunPlan>& plans;
  const std::filesystem::path& directory;
  std::ostream& progress;
  const bool writes;
  std::vector<StudyRun> rows;
};

/// All processes make each run. False when the user has interrupted it.
bool make_one_by_one(const std::vector<RunPlan>& plans, MPI_Comm communicator, Rows& rows) {
  StudyBench bench(plans, communicator);
  while (rows.size() < plans.size()) {
    rows.announce();
    try {
      rows.add(bench.make(plans[rows.size()]));
    } catch (const Interrupted&) {
      return false;
    }
  }
  return true;
}

/// Groups of processes make runs at the same time. False when the user has interrupted it.
bool make_in_groups(const std::vector<RunPlan>& plans, unsigned int group_size,
                    MPI_Comm communicator, Rows& rows) {
  const std::size_t first = rows.size();
  // Rows are in the order of the study, whichever run is ready first.
  std::map<std::size_t, StudyRun> made;
  bool is_interrupted = false;
  const Foreman foreman = {[&](unsigned int task) { rows.announce(first + task); },
                           [&](unsigned int task, const std::string& csv) {
                             auto runs = read_study_csv(csv);
                             is_interrupted = is_interrupted ||
                                              rollwave::is_interrupted(MPI_COMM_SELF) ||
                                              runs.empty();
                             if (!runs.empty())
                               made[first + task] = std::move(runs.front());
                             for (auto next = made.find(rows.size()); next != made.end();
                                  next = made.find(rows.size())) {
                               rows.add(std::move(next->second));
                               made.erase(next);
                             }
                             return !is_interrupted;
                           }};
  std::optional<StudyBench> bench;
  farm_out(communicator, group_size, plans.size() - first, foreman,
           [&](unsigned int task, MPI_Comm group) {
             if (!bench)
               bench.emplace(plans, group);
             try {
               return study_csv({bench->make(plans[first + task])});
             } catch (const Interrupted&) {
               return std::string(); // which tells
             }
           });
  return !is_interrupted;
}

} // namespace

Study run_study(const Parameters& parameters, const std::filesystem::path& directory,
                std::ostream& progress, MPI_Comm communicator) {
  const std::vector<RunPlan> plans = plan_runs(parameters);
  const auto& published = parameters.study.published_steps;
  if (!published.empty() && published.size() != plans.size())
    throw BadInput(refusal(parameters.settings, "Study", "Published steps",
                           "there are " + std::to_string(published.size()) + " entries for " +
                               std::to_string(plans.size()) + " runs"));
  const unsigned int group_size = parameters.study.processes_per_scene;
  const bool is_farmed = group_size > 0 && !is_alone(communicator);
  if (is_farmed && group_size >= count_processes(communicator))
    throw BadInput(refusal(parameters.settings, "Study", "Processes per scene",
                           "one process hands out the scenes, so that there must be more than "
                           "these"));
  // What is refused is refused before anything is written.
  for (const RunPlan& plan : plans)
    try {
      make_scene(plan.parameters);
      check_simulation(plan.parameters, is_farmed ? group_size : count_processes(communicator));
    } catch (const BadValue& value) {
      throw BadInput(refusal(plan.parameters.settings, value));
    }

  const bool is_first = process_number(communicator) == 0;
  const std::string earlier = share_text(
      communicator, is_first ? claim_directory(parameters, directory, progress) : std::string());
  Rows rows(parameters, plans, directory, progress, is_first);
  std::vector<StudyRun> earlier_runs = read_study_csv(earlier);
  for (StudyRun& run : earlier_runs) {
    rows.announce("  (done before)");
    rows.adopt(std::move(run));
  }
  const bool is_complete = is_farmed ? make_in_groups(plans, group_size, communicator, rows)
                                     : make_one_by_one(plans, communicator, rows);
  return std::move(rows).end(!is_complete);
}

} // namespace rollwave
