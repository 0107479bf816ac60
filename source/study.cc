#include "study.h"

#include "atomic_file.h"
#include "errors.h"
#include "output.h"
#include "processes.h"
#include "simulation.h"
#include "task_farm.h"
#include "true_errors.h"
#include "verification.h"

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <map>
#include <new>
#include <optional>
#include <ostream>
#include <sstream>
#include <tuple>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// All combinations of one setting from each list, the last list varying fastest.
std::vector<std::vector<Setting>> combinations(const std::vector<std::vector<Setting>>& lists) {
  std::vector<std::vector<Setting>> all(1);
  for (const auto& list : lists) {
    std::vector<std::vector<Setting>> longer;
    for (const auto& combination : all)
      for (const Setting& setting : list) {
        longer.push_back(combination);
        longer.back().push_back(setting);
      }
    all = std::move(longer);
  }
  return all;
}

/// What one run is to do: all that is set, and of that what varies within the scene.
struct Plan {
  std::string scene;
  std::vector<Setting> varied;
  Parameters parameters; ///< without a study
};

std::vector<Plan> make_plans(const Parameters& parameters) {
  std::vector<Parameters::NamedScene> scenes = parameters.study.scenes;
  if (scenes.empty())
    scenes.push_back({"", {}});
  std::vector<Plan> plans;
  for (const auto& scene : scenes)
    for (const auto& varied : combinations(parameters.study.vary)) {
      std::vector<Setting> settings = parameters.settings;
      settings.insert(settings.end(), scene.settings.begin(), scene.settings.end());
      settings.insert(settings.end(), varied.begin(), varied.end());
      plans.push_back({scene.name, varied, read_parameters(settings)});
    }
  return plans;
}

/// The adaptive solution with quadratic elements that errors are measured against where no exact
/// one is known.
Reference compute_reference(const Scene& scene, const Parameters& parameters,
                            MPI_Comm communicator) {
  std::vector<Setting> settings = parameters.settings;
  const auto set = [&](const std::string& section, const std::string& key,
                       const std::string& value) {
    settings.push_back({section, key, value, "reference of the study"});
  };
  set("Mesh", "Degree", "2");
  set("Mesh", "Global refinements", "0");
  set("Mesh", "Adaptive cycles", "1000");
  set("Mesh", "Wanted relative error", "0");
  set("Mesh", "Indicator", "residual");
  set("Mesh", "Marking", "bulk");
  set("Mesh", "Most unknowns", std::to_string(parameters.study.reference_unknowns));
  set("Contact", "Method", "active set");
  set("Certificate", "Error bound", "true");
  const Solution solution = simulate(scene, read_parameters(settings), communicator);
  if (solution.result.is_interrupted)
    throw Interrupted(solution.result.shortfall);
  std::ostringstream name;
  name << "an adaptive solution with " << solution.result.mesh.dofs
       << " unknowns, its own relative error certified to " << std::setprecision(2)
       << solution.result.certified->relative;
  return discrete_reference(scene, *solution.space, solution.result, name.str());
}

/// Runs that differ in their mesh only share their reference.
class References {
public:
  explicit References(MPI_Comm communicator) : communicator(communicator) {}

  const Reference& find(const Scene& scene, const Parameters& parameters) {
    const auto key = std::tuple(scene.inner_radius, scene.outer_radius, scene.angular_velocity,
                                parameters.road.distance, parameters.cylinder.radial_force,
                                scene.zone_begin, scene.zone_end);
    const auto known = references.find(key);
    if (known != references.end())
      return known->second;
    const auto exact = find_exact_solution(scene, parameters);
    return references
        .emplace(key, exact ? exact_reference(*exact)
                            : compute_reference(scene, parameters, communicator))
        .first->second;
  }

private:
  const MPI_Comm communicator;
  std::map<std::tuple<double, double, double, double, std::string, double, double>, Reference>
      references;
};

/// Runs that have this in common can share a mesh.
auto mesh_key(const Parameters& parameters) {
  const auto& mesh = parameters.mesh;
  return std::tuple(parameters.cylinder.inner_radius, parameters.cylinder.outer_radius,
                    parameters.road.contact_zone, mesh.degree, mesh.radial_cells,
                    mesh.angular_cells, mesh.global_refinements, mesh.adaptive_cycles,
                    mesh.wanted_relative_error, mesh.indicator, mesh.marking, mesh.marked_fraction,
                    mesh.most_unknowns, parameters.solver.kind);
}

using MeshKey = decltype(mesh_key(Parameters()));

bool is_adaptive(const Parameters& parameters) {
  return parameters.mesh.wanted_relative_error > 0 ||
         parameters.mesh.adaptive_cycles.value_or(0) > 0;
}

/// Whether a run begins with the mesh that the run before has ended with.
bool continues_mesh(const Parameters& parameters) {
  return is_adaptive(parameters) && parameters.study.continue_meshes;
}

/// The scenes of a study one after the other, each on the mesh of the one before where that is
/// possible.
class Sweep {
public:
  explicit Sweep(MPI_Comm communicator) : communicator(communicator) {}

  /// Announces a run. Where the zone of contact is left to the program, the runs that share a mesh
  /// share the widest zone, in which the roads of the others cannot be touched either.
  void announce(const Scene& scene, const Parameters& parameters) {
    if (is_adaptive(parameters) && !parameters.study.continue_meshes)
      return;
    const auto [entry, is_new] =
        shared.try_emplace(mesh_key(parameters), Shared{scene.zone_begin, scene.zone_end, 0});
    Shared& with = entry->second;
    with.zone_begin = std::min(with.zone_begin, scene.zone_begin);
    with.zone_end = std::max(with.zone_end, scene.zone_end);
    ++with.n_runs;
  }

  Solution& solve(Scene scene, const Parameters& parameters) {
    const MeshKey key = mesh_key(parameters);
    Solution previous;
    if (last_key == key)
      previous = std::move(solution);
    solution = {};
    last_key.reset(); // a run that fails leaves nothing
    const auto entry = shared.find(key);
    if (entry == shared.end() || entry->second.n_runs == 1)
      return solution = simulate(scene, parameters, communicator);
    scene.zone_begin = entry->second.zone_begin;
    scene.zone_end = entry->second.zone_end;
    solution = simulate_next(scene, parameters, std::move(previous), communicator);
    last_key = key;
    return solution;
  }

private:
  struct Shared {
    double zone_begin;
    double zone_end;
    unsigned int n_runs;
  };

  const MPI_Comm communicator;
  std::map<MeshKey, Shared> shared;
  std::optional<MeshKey> last_key;
  Solution solution;
};

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
/// directory that of this study.
std::string claim_directory(const Parameters& parameters, const std::filesystem::path& directory) {
  const std::string own = parameters_text(parameters);
  if (own == read_text(directory / "parameters.prm"))
    return read_text(directory / "study.csv");
  // In this order: rows beside the parameters of another study would be taken for its own.
  std::error_code error;
  std::filesystem::remove(directory / "study.csv", error);
  if (error)
    throw NotWritten((directory / "study.csv").string() +
                     " could not be removed: " + error.message());
  write_file(directory / "parameters.prm", own);
  return {};
}

/// The @p finished ones of all runs, but for the last ones where the next run continues their mesh:
/// it is made anew with them.
std::vector<StudyRun> runs_to_keep(std::vector<StudyRun> finished, const std::vector<Plan>& plans) {
  if (finished.size() >= plans.size())
    return finished;
  const Parameters& next = plans[finished.size()].parameters;
  if (continues_mesh(next))
    while (!finished.empty() && mesh_key(plans[finished.size() - 1].parameters) == mesh_key(next))
      finished.pop_back();
  return finished;
}

/// What runs that are made one after the other on the same processes share.
class Bench {
public:
  Bench(const std::vector<Plan>& plans, MPI_Comm communicator)
      : sweep(communicator), references(communicator) {
    for (const Plan& plan : plans)
      sweep.announce(make_scene(plan.parameters), plan.parameters);
  }

  /// A run, with the reason where it cannot be solved.
  /// @throws Interrupted also when there is a result that lacks something.
  StudyRun make(const Plan& plan) {
    StudyRun run;
    try {
      solve(plan.parameters, run);
    } catch (const Interrupted&) {
      throw;
    } catch (const NotSolved& failure) {
      run.failure = failure.what();
    } catch (const std::bad_alloc&) {
      run.failure = NotEnoughMemory().what();
    }
    return run;
  }

private:
  void solve(const Parameters& parameters, StudyRun& run) {
    const Scene scene = make_scene(parameters);
    Solution& solution = sweep.solve(scene, parameters);
    Result& result = solution.result;
    if (result.is_interrupted)
      throw Interrupted(result.shortfall);
    if (parameters.study.true_errors) {
      const Reference& reference = references.find(scene, parameters);
      result.errors = measure_true_errors(*solution.space, solution.displacement, result,
                                          solution.certificate, reference);
      run.reference = reference.name;
    }
    run.figures = figures_of(to_lengths(result, scene.unit));
    run.failure = result.shortfall;
  }

  Sweep sweep;
  References references;
};

/// Writes study.csv, and parameters.prm where the directory has been removed.
void write_runs(const Parameters& parameters, const std::filesystem::path& directory,
                const std::vector<StudyRun>& runs) {
  if (!std::filesystem::exists(directory / "parameters.prm"))
    write_file(directory / "parameters.prm", parameters_text(parameters));
  write_file(directory / "study.csv", study_csv(runs));
}

/// The rows of a study in their order, those of this call and of earlier ones.
class Rows {
public:
  Rows(const Parameters& parameters, const std::vector<Plan>& plans,
       const std::filesystem::path& directory, std::ostream& progress, bool writes)
      : parameters(parameters), plans(plans), directory(directory), progress(progress),
        writes(writes) {}

  void announce(const char* remark = "") const { announce(rows.size(), remark); }

  void announce(std::size_t number, const char* remark = "") const {
    const Plan& plan = plans[number];
    progress << "run " << number + 1 << " of " << plans.size() << ':';
    if (!plan.scene.empty())
      progress << "  " << plan.scene;
    for (const Setting& setting : plan.varied)
      progress << "  " << setting.path() << " = " << setting.value;
    progress << remark << std::endl;
  }

  /// Appends what has been found before.
  void adopt(StudyRun run) {
    const Plan& plan = plans[rows.size()];
    run.scene = plan.scene;
    run.settings = plan.varied;
    if (!parameters.study.published_steps.empty())
      run.published_steps = parameters.study.published_steps[rows.size()];
    rows.push_back(std::move(run));
  }

  /// Appends a run that has been made, and brings study.csv up to date.
  void add(StudyRun run) {
    if (!run.failure.empty())
      progress << "  not solved: " << run.failure << std::endl;
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
  const std::vector<Plan>& plans;
  const std::filesystem::path& directory;
  std::ostream& progress;
  const bool writes;
  std::vector<StudyRun> rows;
};

/// All processes make each run. False when the user has interrupted it.
bool make_one_by_one(const std::vector<Plan>& plans, MPI_Comm communicator, Rows& rows) {
  Bench bench(plans, communicator);
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

/// Groups of processes make runs at the same time, those together that continue a mesh. False when
/// the user has interrupted it.
bool make_in_groups(const std::vector<Plan>& plans, unsigned int group_size, MPI_Comm communicator,
                    Rows& rows) {
  struct Task {
    std::size_t begin, end; ///< of its runs
  };
  std::vector<Task> tasks;
  for (std::size_t i = rows.size(); i < plans.size(); ++i)
    if (!tasks.empty() && continues_mesh(plans[i].parameters) &&
        mesh_key(plans[i - 1].parameters) == mesh_key(plans[i].parameters))
      tasks.back().end = i + 1;
    else
      tasks.push_back({i, i + 1});

  // Rows are in the order of the study, whichever run is ready first.
  std::map<std::size_t, StudyRun> made;
  bool is_interrupted = false;
  const Foreman foreman = {[&](unsigned int task) {
                             for (std::size_t i = tasks[task].begin; i < tasks[task].end; ++i)
                               rows.announce(i);
                           },
                           [&](unsigned int task, const std::string& csv) {
                             auto runs = read_study_csv(csv);
                             is_interrupted = is_interrupted ||
                                              runs.size() < tasks[task].end - tasks[task].begin;
                             for (std::size_t k = 0; k < runs.size(); ++k)
                               made[tasks[task].begin + k] = std::move(runs[k]);
                             for (auto next = made.find(rows.size()); next != made.end();
                                  next = made.find(rows.size())) {
                               rows.add(std::move(next->second));
                               made.erase(next);
                             }
                             return !is_interrupted;
                           }};
  std::optional<Bench> bench;
  farm_out(communicator, group_size, tasks.size(), foreman, [&](unsigned int task, MPI_Comm group) {
    if (!bench)
      bench.emplace(plans, group);
    std::vector<StudyRun> runs;
    try {
      for (std::size_t i = tasks[task].begin; i < tasks[task].end; ++i)
        runs.push_back(bench->make(plans[i]));
    } catch (const Interrupted&) {
      // a result that is too short tells
    }
    return study_csv(runs);
  });
  return !is_interrupted;
}

} // namespace

Study run_study(const Parameters& parameters, const std::filesystem::path& directory,
                std::ostream& progress, MPI_Comm communicator) {
  const std::vector<Plan> plans = make_plans(parameters);
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
  for (const Plan& plan : plans)
    make_scene(plan.parameters); // refuses before anything is written

  const bool is_first = process_number(communicator) == 0;
  const std::string earlier =
      share_text(communicator, is_first ? claim_directory(parameters, directory) : std::string());
  Rows rows(parameters, plans, directory, progress, is_first);
  for (StudyRun& run : runs_to_keep(read_study_csv(earlier), plans)) {
    rows.announce("  (done before)");
    rows.adopt(std::move(run));
  }
  const bool is_complete = is_farmed ? make_in_groups(plans, group_size, communicator, rows)
                                     : make_one_by_one(plans, communicator, rows);
  return std::move(rows).end(!is_complete);
}

} // namespace rollwave
