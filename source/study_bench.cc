#include "study_bench.h"

#include "errors.h"
#include "memory.h"
#include "processes.h"
#include "scene.h"
#include "simulation.h"
#include "true_errors.h"
#include "verification.h"

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <iomanip>
#include <map>
#include <new>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// The adaptive solution with quadratic elements that errors are measured against where no exact
/// one is known.
Reference compute_reference(const Scene& scene, const Parameters& parameters,
                            MPI_Comm communicator) {
  std::vector<Setting> settings = parameters.settings;
  const auto set = [&](const std::string& section, const std::string& key,
                       const std::string& value) {
    settings.push_back({section, key, value, "reference of the study"});
  };
  // Begun on a mesh that leaves room to refine.
  auto [radial_cells, angular_cells] =
      std::pair(parameters.mesh.radial_cells, parameters.mesh.angular_cells);
  while (16. * radial_cells * angular_cells > parameters.study.reference_unknowns &&
         angular_cells > 24) {
    radial_cells = (radial_cells + 1) / 2;
    angular_cells = (angular_cells + 1) / 2;
  }
  set("Mesh", "Radial cells", std::to_string(radial_cells));
  set("Mesh", "Angular cells", std::to_string(angular_cells));
  set("Mesh", "Degree", "2");
  set("Mesh", "Global refinements", "0");
  set("Mesh", "Adaptive cycles", "1000");
  set("Mesh", "Wanted relative error", "0");
  set("Mesh", "Indicator", "residual");
  set("Mesh", "Marking", "bulk");
  set("Mesh", "Most unknowns", std::to_string(parameters.study.reference_unknowns));
  set("Contact", "Method", "active set");
  set("Certificate", "Error bound", "true");
  set("Certificate", "Load bounds", "false");
  const Solution solution = simulate(scene, read_parameters(settings), communicator);
  if (solution.result.is_interrupted)
    throw Interrupted(solution.result.shortfall);
  if (!solution.certificate)
    throw NotSolved(solution.result.shortfall);
  std::ostringstream name;
  name << "an adaptive solution with " << solution.result.mesh.dofs
       << " unknowns, its own relative error certified to " << std::setprecision(2)
       << solution.result.certified->relative;
  return discrete_reference(scene, *solution.space, solution.result, *solution.certificate,
                            name.str());
}

} // namespace

/// Runs that differ in their mesh only share their reference.
class References {
public:
  explicit References(MPI_Comm communicator) : communicator(communicator) {}

  const Reference& find(const Scene& scene, const Parameters& parameters) {
    const auto key = std::tuple(scene.unit, scene.inner_radius, scene.outer_radius,
                                scene.angular_velocity, parameters.road.distance,
                                parameters.cylinder.radial_force, scene.zone_begin, scene.zone_end);
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
  std::map<std::tuple<double, double, double, double, double, std::string, double, double>,
           Reference>
      references;
};

/// The scenes of a study one after the other, each on the mesh of the one before where that is
/// possible.
class Sweep {
public:
  explicit Sweep(MPI_Comm processes) : processes(processes) {}

  MPI_Comm communicator() const { return processes; }

  /// Announces a run.
  void announce(const Scene& scene, const Parameters& parameters) {
    if (most_cycles(parameters) > 0 && !parameters.study.continue_meshes)
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

  void forget() { last_key.reset(); }

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

void solve(const Parameters& parameters, Sweep& sweep, References& references, StudyRun& run) {
  const Scene scene = make_scene(parameters);
  Solution& solution = sweep.solve(scene, parameters);
  Result& result = solution.result;
  if (result.is_interrupted)
    throw Interrupted(result.shortfall);
  const auto note = [&] {
    result.peak_memory_mib = Utilities::MPI::max(peak_memory_mib(), solution.space->communicator());
    run.figures = figures_of(to_lengths(result, scene.unit));
    run.failure = result.shortfall;
    run.remarks.clear();
    for (const std::string& remark : result.remarks)
      run.remarks += (run.remarks.empty() ? "" : " | ") + remark;
  };
  note(); // what stays where no reference can be made
  if (parameters.study.true_errors) {
    const Reference& reference = references.find(scene, parameters);
    result.errors = measure_true_errors(*solution.space, solution.displacement, result,
                                        solution.certificate, reference);
    run.reference = reference.name;
    if (!result.errors->is_resolved)
      result.errors.reset();
    note();
  }
}

} // namespace

struct StudyBench::Shared {
  Sweep sweep;
  References references;
};

StudyBench::StudyBench(const std::vector<RunPlan>& plans, MPI_Comm communicator)
    : shared(new Shared{Sweep(communicator), References(communicator)}) {
  for (const RunPlan& plan : plans)
    shared->sweep.announce(make_scene(plan.parameters), plan.parameters);
}

StudyBench::~StudyBench() = default;

void StudyBench::forget_mesh() {
  shared->sweep.forget();
}

StudyRun StudyBench::make(const RunPlan& plan) {
  StudyRun run;
  try {
    solve(plan.parameters, shared->sweep, shared->references, run);
  } catch (const Interrupted&) {
    throw;
  } catch (const NotSolved& failure) {
    run.failure = failure.what();
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
