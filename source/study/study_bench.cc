#include "rollwave/study/study_bench.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/memory.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/run/simulation.h"
#include "rollwave/scene/scene.h"
#include "rollwave/verify/reference_solution.h"
#include "rollwave/verify/true_errors.h"

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <map>
#include <new>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

namespace rollwave {

using namespace dealii;

/// The exact solutions of scenes, nullopt where none is known: runs that differ in their mesh only
/// share one.
class ExactSolutions {
public:
  const std::optional<ExactSolution>& find(const Scene& scene) {
    const auto key =
        std::tuple(scene.unit, scene.inner_radius, scene.outer_radius, scene.angular_velocity,
                   scene.road_distance, scene.force_text, scene.zone_begin, scene.zone_end);
    const auto entry = known.find(key);
    return entry != known.end() ? entry->second
                                : known.emplace(key, find_exact_solution(scene)).first->second;
  }

private:
  std::map<std::tuple<double, double, double, double, double, std::string, double, double>,
           std::optional<ExactSolution>>
      known;
};

/// The scenes of a study one after the other, each on the mesh of the one before where that is
/// possible.
class Sweep {
public:
  explicit Sweep(MPI_Comm processes) : processes(processes) {}

  MPI_Comm communicator() const { return processes; }

  /// Announces a run.
  void announce(const Scene& scene, const Parameters& parameters) {
    if (most_cycles(parameters.mesh) > 0)
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
      previous = std::move(*solution);
    solution.reset(); // assignment would delete the mesh under what lives on it
    last_key.reset(); // a run that fails leaves nothing
    const auto entry = shared.find(key);
    if (entry == shared.end() || entry->second.n_runs == 1)
      return solution.emplace(simulate(scene, parameters, processes));
    scene.zone_begin = entry->second.zone_begin;
    scene.zone_end = entry->second.zone_end;
    solution.emplace(simulate_next(scene, parameters, std::move(previous), processes));
    last_key = key;
    return *solution;
  }

private:
  struct Shared {
    double zone_begin;
    double zone_end;
    unsigned int n_runs;
  };

  const MPI_Comm processes;
  std::map<MeshKey, Shared> shared;
  std::optional<MeshKey> last_key;
  std::optional<Solution> solution;
};

namespace {

void solve(const Parameters& parameters, Sweep& sweep, ExactSolutions& exact_solutions,
           StudyRun& run) {
  const Scene scene = make_scene(parameters);
  Solution& solution = sweep.solve(scene, parameters);
  Result& result = solution.result;
  if (result.is_interrupted)
    throw Interrupted(shortfall_text(result));
  if (parameters.study.true_errors)
    if (const auto& exact = exact_solutions.find(scene)) {
      result.errors = measure_true_errors(*solution.space, solution.displacement, result,
                                          solution.certificate, *exact);
      run.reference = "the semi-analytic solution";
      if (!result.errors->is_resolved)
        result.errors.reset();
    }
  result.peak_memory_mib = Utilities::MPI::max(peak_memory_mib(), solution.space->communicator());
  run.figures = figures_of(to_lengths(result, scene.unit));
  run.failure = shortfall_text(result);
  for (const std::string& remark : result.remarks)
    run.remarks += (run.remarks.empty() ? "" : " | ") + remark;
}

} // namespace

struct StudyBench::Shared {
  Sweep sweep;
  ExactSolutions exact_solutions;
};

StudyBench::StudyBench(const std::vector<RunPlan>& plans, MPI_Comm communicator)
    : shared(new Shared{Sweep(communicator), {}}) {
  for (const RunPlan& plan : plans)
    shared->sweep.announce(make_scene(plan.parameters), plan.parameters);
}

StudyBench::~StudyBench() = default;

StudyRun StudyBench::make(const RunPlan& plan) {
  StudyRun run;
  try {
    solve(plan.parameters, shared->sweep, shared->exact_solutions, run);
  } catch (const Interrupted&) {
    throw;
  } catch (const NotSolved& failure) {
    run.failure = failure.what();
  } catch (const BadValue& value) {
    run.failure = refusal(plan.parameters.settings, value);
  } catch (const BadInput& refusal) { // by the mesh, such as for a zone without a node
    run.failure = refusal.what();
  } catch (const std::bad_alloc&) {
    if (!is_alone(shared->sweep.communicator()))
      throw; // the others do not know
    run.failure = NotEnoughMemory().what();
  }
  return run;
}

} // namespace rollwave
