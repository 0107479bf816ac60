#include "rollwave/study/study_solver.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/memory.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/output/result_files.h"
#include "rollwave/run/attempt.h"
#include "rollwave/run/quantities.h"
#include "rollwave/run/simulation.h"
#include "rollwave/scene/scene.h"
#include "rollwave/verify/reference_solution.h"
#include "rollwave/verify/true_errors.h"

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// True if two runs have the same mesh, which neither refines.
bool have_same_mesh(const RunOptions& one, const RunOptions& other) {
  return most_cycles(one.mesh) == 0 && most_cycles(other.mesh) == 0 &&
         one.cylinder.inner_radius == other.cylinder.inner_radius &&
         one.cylinder.outer_radius == other.cylinder.outer_radius &&
         one.mesh.MeshOptions::operator==(other.mesh) &&
         one.road.contact_zone == other.road.contact_zone;
}

/// True if two runs have the same mesh and stiffness.
bool have_same_system(const RunOptions& one, const RunOptions& other) {
  return have_same_mesh(one, other) &&
         one.cylinder.angular_velocity == other.cylinder.angular_velocity &&
         one.material.wave_speed() == other.material.wave_speed();
}

/// True if two runs have the same force relative to the shear modulus.
bool have_same_force(const RunOptions& one, const RunOptions& other) {
  return one.cylinder.radial_force == other.cylinder.radial_force &&
         one.material.shear_modulus == other.material.shear_modulus;
}

/// The value for a key, computed when it is first asked for.
template <typename Known, typename Compute>
const auto& known_or_computed(Known& known, const typename Known::value_type::first_type& key,
                              const Compute& compute) {
  const auto entry =
      std::find_if(known.begin(), known.end(), [&](const auto& pair) { return pair.first == key; });
  return entry != known.end() ? entry->second : known.emplace_back(key, compute()).second;
}

} // namespace

StudySolver::StudySolver(const std::vector<RunPlan>& plans, const Parameters& study,
                         const Progress& progress, MPI_Comm communicator)
    : plans(plans), study(study), progress(progress), communicator(communicator) {}

RunRecord StudySolver::record_of(unsigned int number, const OwnFiles& files) {
  const RunPlan& plan = plans[number];
  RunRecord run;
  run.files = files;
  const auto fail = [&run](const std::string& why) {
    run.notes.push_back({Note::Kind::shortfall, why});
  };
  try {
    solve(number, run);
  } catch (const Interrupted&) {
    throw;
  } catch (const NotWritten&) {
    throw;
  } catch (const NotSolved& failure) {
    fail(failure.what());
  } catch (const BadValue& value) {
    fail(refusal(plan.parameters.settings, value));
  } catch (const BadInput& refusal) { // by the mesh, such as for a zone without a node
    fail(refusal.what());
  } catch (const std::exception& failure) {
    if (!is_serial(communicator))
      throw; // the other processes would wait
    const bool is_short = dynamic_cast<const std::bad_alloc*>(&failure);
    fail(is_short ? NotEnoughMemory().what() : reason_of(failure));
  }
  return run;
}

/// Solves a run whose time is compared with others. A short one is solved three times and the
/// fastest counts: the first includes page faults and the start of threads.
Solution StudySolver::solve_timed(const RunOptions& options) {
  solution.reset(); // frees its memory first
  const Scene scene = make_scene(options);
  const auto seconds = [this](const Solution& solution) {
    return Utilities::MPI::max(solution.result.statistics.total_seconds(), communicator);
  };
  std::optional<Solution> fastest = simulate(scene, options, communicator, progress);
  constexpr double short_seconds = 0.2;
  for (int repetition = 0; repetition < 2 && seconds(*fastest) < short_seconds; ++repetition) {
    Solution again = simulate(scene, options, communicator);
    if (seconds(again) < seconds(*fastest))
      fastest.emplace(std::move(again));
  }
  return std::move(*fastest);
}

/// The zone that contains those of this run and of its neighbours in the study with the same
/// system, the same for all of them, so that rows do not depend on where a study goes on.
std::pair<double, double> StudySolver::widest_zone(unsigned int number) const {
  const auto shares = [&](unsigned int other) {
    return have_same_system(plans[number].parameters, plans[other].parameters);
  };
  unsigned int first = number;
  while (first > 0 && shares(first - 1))
    --first;
  std::pair<double, double> widest = make_scene(plans[first].parameters).zone();
  for (unsigned int run = first + 1; run < plans.size() && shares(run); ++run) {
    const auto [begin, end] = make_scene(plans[run].parameters).zone();
    widest = {std::min(widest.first, begin), std::max(widest.second, end)};
  }
  return widest;
}

/// True if two runs and all those between them have the same system, and with it one
/// widest_zone(): runs between them may be known, or belong to another part of the study.
bool StudySolver::share_system(unsigned int earlier, unsigned int number) const {
  for (unsigned int run = earlier; run < number; ++run)
    if (!have_same_system(plans[run].parameters, plans[number].parameters))
      return false;
  return true;
}

/// Solves a run with the mesh and the matrices of the run made before, as far as it has the same.
Solution StudySolver::solve_shared(unsigned int number, RunRecord& run) {
  const RunOptions& parameters = plans[number].parameters;
  const Scene scene = make_scene(parameters);
  const bool has_mesh = last && have_same_mesh(plans[*last].parameters, parameters),
             has_system = last && share_system(*last, number),
             has_load = has_system && have_same_force(plans[*last].parameters, parameters),
             is_followed = number + 1 < plans.size() &&
                           have_same_mesh(parameters, plans[number + 1].parameters);
  std::optional<Mesh> mesh;
  if (has_mesh) {
    mesh = std::move(solution->mesh);
    run.shared = has_system ? "mesh and matrices" : "mesh";
  }
  last.reset();     // if this run fails, the next one makes its own mesh
  solution.reset(); // frees its memory first
  if (!has_system)
    shared.reset();
  if (!has_mesh && !is_followed)
    return simulate(scene, parameters, communicator, progress);
  RunStatistics statistics;
  if (!mesh)
    mesh = make_mesh(scene, parameters, communicator, statistics);
  if (!shared)
    shared.emplace(MeshObjects{make_system(*mesh->space, scene, widest_zone(number), statistics)});
  if (!has_load)
    shared->load = make_load(shared->system, scene, statistics);
  Solution result =
      solve_on_shared({parameters, std::move(*mesh), std::move(statistics)}, *shared, scene);
  last = number;
  return result;
}

void StudySolver::solve(unsigned int number, RunRecord& run) {
  const RunPlan& plan = plans[number];
  solution.emplace(study.study.true_errors ? solve_timed(plan.parameters)
                                           : solve_shared(number, run));
  Result& result = solution->result;
  if (result.is_interrupted)
    throw Interrupted(shortfall_text(result.notes));
  const Scene& scene = solution->scene;
  const auto& [cylinder, road, material] =
      std::tie(plan.parameters.cylinder, plan.parameters.road, plan.parameters.material);
  if (study.study.true_errors)
    if (const auto exact =
            known_or_computed(exact_solutions, {cylinder, road, material, scene.road.distance},
                              [&] { return find_exact_solution(scene, nullptr, communicator); })) {
      result.errors = measure_true_errors(*solution, *exact);
      if (!scene.has_distance())
        result.errors->exact_distance = known_or_computed(
            exact_distances, {cylinder, road, material, 0}, // the same on all meshes
            [&] { return find_exact_distance(scene, communicator); });
      for (Note& note : contradicted_guarantees(result, *exact, scene.units))
        result.notes.push_back(std::move(note));
      run.reference = "the semi-analytic solution";
    }
  result.peak_memory_mib = Utilities::MPI::max(peak_memory_mib(), communicator);
  run.notes = result.notes;
  if (!run.files.kinds.empty())
    write_files(plan, run);
  run.values = values_of(result, scene.units);
  run.profile = profile_of(result, scene.units);
}

/// Writes the files of the run that was solved last, and puts their sizes and remarks into its
/// record.
void StudySolver::write_files(const RunPlan& plan, RunRecord& run) {
  const auto own_directory = study.output.directory / directory_of_run(plan.digest);
  const std::string origin = last_of(study.settings, "Study/Files of each run")->origin;
  const Parameters parameters =
      with_values(plan.parameters, {read({"Output", "Files", text_of(run.files.kinds), origin}),
                                    read({"Output", "Directory", own_directory.string(), origin})});
  const WrittenFiles written = write_results(own_directory, parameters, *solution);
  if (process_number(communicator) == 0) // the others need not see the directory
    for (const auto& file : written.files)
      run.sizes[file.filename().string()] = std::filesystem::file_size(file);
  run.notes.insert(run.notes.end(), written.notes.begin(), written.notes.end());
}

} // namespace rollwave
