#include "rollwave/study/study_solver.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/memory.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/output/result_files.h"
#include "rollwave/run/attempt.h"
#include "rollwave/run/simulation.h"
#include "rollwave/scene/scene.h"
#include "rollwave/study/run_digest.h"
#include "rollwave/verify/reference_solution.h"
#include "rollwave/verify/true_errors.h"

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <exception>
#include <new>

namespace rollwave {

using namespace dealii;

namespace {

/// The settings of a run that affect its mesh and matrices, or its scene.
std::map<std::string, std::string> settings_of(const Parameters& study, const RunPlan& plan,
                                               unsigned int affected) {
  std::map<std::string, std::string> settings;
  for (const Setting& setting : settings_of_run(study, plan))
    if (key_of(setting).affects & affected)
      settings[setting.path()] = setting.value;
  return settings;
}

/// Adds the digest to parameters.prm, by which a later call sees that all files are there; not if
/// that is the file that was read.
void mark_complete(const WrittenFiles& written, const std::string& digest) {
  for (const std::filesystem::path& file : written.files)
    if (file.filename() == "parameters.prm")
      append_to_file(file, "\n# The files of this run are complete: " + digest + "\n");
}

} // namespace

StudySolver::StudySolver(const std::vector<RunPlan>& plans, const Parameters& study,
                         const std::filesystem::path& directory, const Progress& progress,
                         MPI_Comm communicator)
    : plans(plans), study(study), directory(directory), progress(progress),
      communicator(communicator) {
  if (study.study.true_errors)
    return;
  std::map<Settings, unsigned int> n_runs;
  for (const RunPlan& plan : plans)
    if (most_cycles(plan.parameters.mesh) == 0) {
      const Scene scene = make_scene(plan.parameters);
      const Settings key = settings_of(study, plan, Affects::mesh);
      auto& zone = widest_zone.try_emplace(key, scene.zone_begin, scene.zone_end).first->second;
      zone = {std::min(zone.first, scene.zone_begin), std::max(zone.second, scene.zone_end)};
      ++n_runs[key];
    }
  for (const auto& [key, n] : n_runs)
    if (n == 1)
      widest_zone.erase(key);
}

StudyRun StudySolver::solve(unsigned int number) {
  const RunPlan& plan = plans[number];
  StudyRun run;
  if (!study.study.files_of_each_run.empty())
    run.files = directory_of_run(number);
  try {
    solve(plan, run);
  } catch (const Interrupted&) {
    throw;
  } catch (const NotWritten&) {
    throw;
  } catch (const NotSolved& failure) {
    run.failure = failure.what();
  } catch (const BadValue& value) {
    run.failure = refusal(settings_of_run(study, plan), value);
  } catch (const BadInput& refusal) { // by the mesh, such as for a zone without a node
    run.failure = refusal.what();
  } catch (const std::exception& failure) {
    if (!is_serial(communicator))
      throw; // the other processes would wait
    const bool is_short = dynamic_cast<const std::bad_alloc*>(&failure);
    run.failure = is_short ? NotEnoughMemory().what() : reason_of(failure);
  }
  if (!run.is_solved())
    run.files.clear();
  return run;
}

/// Solves a run whose time is compared with others. A short one is solved three times and the
/// fastest counts: the first includes page faults and the start of threads.
Solution StudySolver::solve_timed(const RunPlan& plan) {
  solution.reset(); // frees its memory first
  const Scene scene = make_scene(plan.parameters);
  const auto seconds = [this](const Solution& solution) {
    return Utilities::MPI::max(solution.result.statistics.total_seconds(), communicator);
  };
  std::optional<Solution> fastest = simulate(scene, plan.parameters, communicator, progress);
  constexpr double short_seconds = 0.2;
  for (int repetition = 0; repetition < 2 && seconds(*fastest) < short_seconds; ++repetition) {
    Solution again = simulate(scene, plan.parameters, communicator);
    if (seconds(again) < seconds(*fastest))
      fastest.emplace(std::move(again));
  }
  return std::move(*fastest);
}

Solution StudySolver::solve_on_shared_mesh(const RunPlan& plan, StudyRun& run) {
  const Scene scene = make_scene(plan.parameters);
  const Settings key = settings_of(study, plan, Affects::mesh);
  std::optional<Discretisation> mesh;
  if (last_mesh == key) {
    mesh = std::move(solution->mesh);
    run.shared = "mesh";
  }
  solution.reset();  // frees its memory first
  last_mesh.reset(); // if this run fails, the next one makes its own mesh
  const auto zone = widest_zone.find(key);
  if (zone == widest_zone.end())
    return simulate(scene, plan.parameters, communicator, progress);
  RunStatistics statistics;
  if (!mesh)
    mesh.emplace(scene, plan.parameters, communicator, statistics, zone->second);
  Solution shared = simulate(std::move(*mesh), scene, plan.parameters, std::move(statistics));
  last_mesh = key;
  if (!run.shared.empty() && shared.result.statistics.stiffness_assemblies == 0)
    run.shared = "mesh and matrices";
  return shared;
}

void StudySolver::solve(const RunPlan& plan, StudyRun& run) {
  solution.emplace(study.study.true_errors ? solve_timed(plan) : solve_on_shared_mesh(plan, run));
  Result& result = solution->result;
  if (result.is_interrupted)
    throw Interrupted(shortfall_text(result));
  if (study.study.true_errors)
    if (const auto& exact = exact_solution(plan, solution->scene)) {
      result.errors = measure_true_errors(*solution, *exact);
      if (solution->scene.load)
        result.errors->exact_distance = exact_distance(plan, solution->scene);
      run.reference = "the semi-analytic solution";
    }
  result.peak_memory_mib = Utilities::MPI::max(peak_memory_mib(), communicator);
  if (!run.files.empty()) {
    const WrittenFiles written =
        write_results(directory / run.files, parameters_of_files(plan, run.files), *solution);
    if (process_number(communicator) == 0)
      mark_complete(written, digest_of_files(plan.digest, study));
    run.remarks = written.remarks;
  }
  run.values = values_of(result, solution->scene.units);
  run.pressure = pressure_of(result, solution->scene.units);
  run.failure = shortfall_text(result);
  run.remarks.insert(run.remarks.begin(), result.remarks.begin(), result.remarks.end());
}

/// Those of a run that writes its own files.
Parameters StudySolver::parameters_of_files(const RunPlan& plan, const std::string& files) const {
  std::vector<Setting> settings = settings_of_run(study, plan);
  const Setting& kinds = *last_of(study.settings, "Study/Files of each run");
  settings.push_back({"Output", "Files", kinds.value, kinds.origin});
  settings.push_back({"Output", "Directory", (directory / files).string(), kinds.origin});
  Parameters parameters = read_parameters(settings);
  parameters.file = study.file;
  return parameters;
}

std::optional<double> StudySolver::exact_distance(const RunPlan& plan, const Scene& scene) {
  const auto [known, is_first] =
      exact_distances.try_emplace(settings_of(study, plan, Affects::scene));
  if (is_first)
    known->second = find_exact_distance(scene);
  return known->second;
}

const std::optional<ExactSolution>& StudySolver::exact_solution(const RunPlan& plan,
                                                                const Scene& scene) {
  const auto [known, is_first] =
      exact_solutions.try_emplace({settings_of(study, plan, Affects::scene), scene.road.distance});
  if (is_first)
    known->second = find_exact_solution(scene);
  return known->second;
}

} // namespace rollwave
