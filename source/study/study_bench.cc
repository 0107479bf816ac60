#include "rollwave/study/study_bench.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/memory.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/output/output_directory.h"
#include "rollwave/output/result_files.h"
#include "rollwave/run/simulation.h"
#include "rollwave/scene/scene.h"
#include "rollwave/verify/reference_solution.h"
#include "rollwave/verify/true_errors.h"

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <limits>
#include <new>

namespace rollwave {

using namespace dealii;

namespace {

/// What a run has in common with others on its mesh.
std::map<std::string, std::string> mesh_key(const RunPlan& plan) {
  std::map<std::string, std::string> values;
  for (const Key& key : all_keys())
    if (const auto value = plan.identity.find(key.path());
        value != plan.identity.end() && (key.affects & Affects::mesh))
      values.insert(*value);
  return values;
}

} // namespace

StudyBench::StudyBench(const std::vector<RunPlan>& plans, const Parameters& study,
                       const std::filesystem::path& directory, MPI_Comm communicator)
    : plans(plans), study(study), directory(directory), communicator(communicator) {
  if (study.study.true_errors)
    return;
  std::map<MeshKey, unsigned int> n_runs;
  for (const RunPlan& plan : plans)
    if (most_cycles(plan.parameters.mesh) == 0) {
      const Scene scene = make_scene(plan.parameters);
      const MeshKey key = mesh_key(plan);
      auto& zone = widest_zone.try_emplace(key, scene.zone_begin, scene.zone_end).first->second;
      zone = {std::min(zone.first, scene.zone_begin), std::max(zone.second, scene.zone_end)};
      ++n_runs[key];
    }
  for (const auto& [key, n] : n_runs)
    if (n == 1)
      widest_zone.erase(key);
}

StudyRun StudyBench::make(const RunPlan& plan, const std::string& files) {
  StudyRun run;
  run.files = files;
  try {
    if (study.study.true_errors && !is_warm)
      warm_up();
    solve(plan, run);
  } catch (const Interrupted&) {
    throw;
  } catch (const NotSolved& failure) {
    run.failure = failure.what();
  } catch (const BadValue& value) {
    run.failure = refusal(plan.parameters.settings, value);
    run.is_refused = true;
  } catch (const BadInput& refusal) { // by the mesh, such as for a zone without a node
    run.failure = refusal.what();
    run.is_refused = true;
  } catch (const std::bad_alloc&) {
    if (!is_alone(communicator))
      throw; // the others do not know
    run.failure = NotEnoughMemory().what();
  }
  if (!run.is_solved())
    run.files.clear();
  return run;
}

/// The first run of a process also pays for pages of memory and libraries.
void StudyBench::warm_up() {
  is_warm = true;
  const auto smallest =
      std::min_element(plans.begin(), plans.end(), [](const auto& left, const auto& right) {
        return count_unknowns(left.parameters.mesh) < count_unknowns(right.parameters.mesh);
      });
  RunOptions options = smallest->parameters;
  options.mesh.adaptive_cycles = 0;
  options.mesh.wanted_relative_error = 0;
  try {
    simulate(make_scene(options), options, communicator);
  } catch (const Interrupted&) {
    throw;
  } catch (const BadInput&) {
    // Told when its turn comes.
  } catch (const NotSolved&) {
    // Likewise.
  }
}

void StudyBench::solve(const RunPlan& plan, StudyRun& run) {
  Scene scene = make_scene(plan.parameters);
  const MeshKey key = mesh_key(plan);
  Solution previous;
  if (last_mesh == key) {
    previous = std::move(*solution);
    run.shared = "mesh";
  }
  solution.reset();  // assignment would delete the mesh under what lives on it
  last_mesh.reset(); // a run that fails leaves nothing
  if (const auto zone = widest_zone.find(key); zone == widest_zone.end())
    solution.emplace(simulate(scene, plan.parameters, communicator));
  else {
    scene.shared_zone = zone->second;
    solution.emplace(simulate(scene, plan.parameters, communicator, std::move(previous)));
    last_mesh = key;
  }
  Result& result = solution->result;
  if (result.is_interrupted)
    throw Interrupted(shortfall_text(result));
  if (!run.shared.empty() && result.work.stiffness_assemblies == 0)
    run.shared = "mesh and matrices";
  if (study.study.true_errors)
    if (const auto& exact = exact_solution(solution->scene)) {
      result.errors = measure_true_errors(*solution->space, solution->displacement, result,
                                          solution->certificate, *exact);
      run.reference = "the semi-analytic solution";
      if (!result.errors->is_resolved)
        result.errors.reset();
    }
  result.peak_memory_mib = Utilities::MPI::max(peak_memory_mib(), communicator);
  if (!run.files.empty()) {
    Parameters parameters = plan.parameters;
    parameters.output.files = study.study.files_of_each_run;
    write_results(directory / run.files, parameters, *solution);
  }
  const Result own = in_users_units(result, scene.units);
  run.figures = figures_of(own);
  run.pressure = pressure_of(own);
  run.failure = shortfall_text(result);
  run.remarks = result.remarks;
}

const std::optional<ExactSolution>& StudyBench::exact_solution(const Scene& scene) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> key = {scene.inner_radius, scene.outer_radius, scene.angular_velocity,
                                   scene.road_distance, scene.road_curvature,
                                   // An automatic zone leaves the contact free, however wide it is.
                                   scene.has_given_zone ? scene.zone_begin : infinity,
                                   scene.has_given_zone ? scene.zone_end : infinity,
                                   scene.has_nonuniform_force() ? infinity
                                                                : scene.uniform_force.value_or(0)};
  const auto [known, is_new] = exact_solutions.try_emplace(key);
  if (is_new)
    known->second = find_exact_solution(scene);
  return known->second;
}

} // namespace rollwave
