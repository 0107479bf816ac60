#include "rollwave/run/simulation.h"

#include "rollwave/adapt/marking.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/interrupt.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/text.h"
#include "rollwave/contact/load_control.h"
#include "rollwave/mesh/ring_mesh.h"
#include "rollwave/run/attempt.h"
#include "rollwave/run/finish.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace rollwave {

using namespace dealii;

void check_simulation(const Scene& scene, const RunOptions& options) {
  check_mesh_size(with_enough_cells(scene, options.mesh));
  constexpr double most_nodes = 20000; // a dense factorisation takes some minutes
  const double nodes = count_contact_nodes(scene, options.mesh);
  if (nodes > most_nodes && is_serial(MPI_COMM_WORLD)) // of several, each has its own
    throw BadValue("Mesh",
                   options.mesh.global_refinements > 0 ? "Global refinements" : "Angular cells",
                   "about " + rounded(nodes, 6) + " nodes would lie in the zone of contact, and " +
                       rounded(most_nodes, 6) +
                       " are the most: the dense problem of n contact nodes takes n^3 operations; "
                       "use fewer cells along the angle, or a coarse mesh with "
                       "Mesh/Wanted relative error");
}

namespace {

/// The certificate of a solution, where it is wanted and does not fail.
/// @param objects with the dual system, which is made if it is not there yet
std::optional<Certificate> certify_solution(Run& run, MeshObjects& objects,
                                            MeshSolution& solution) {
  std::optional<Certificate> certificate;
  if (!run.options.certificate.error_bound)
    return certificate;
  const RunStatistics::Phase phase(run.statistics, "certificate");
  const RingSpace& space = solution.boundary.space();
  attempt(
      [&] {
        if (!objects.dual)
          objects.dual = std::make_unique<DualSystem>(space, objects.system.shapes, solution.scene,
                                                      run.statistics);
        certificate = certify(solution, solution.displacement,
                              objects.load ? &objects.load->integral : nullptr, *objects.dual,
                              run.statistics);
      },
      "the error could not be certified",
      "use fewer unknowns, or set Certificate/Error bound to false", space.communicator(),
      solution.result.notes);
  return certificate;
}

/// eta_K of each active cell by Mesh/Indicator; Kelly's if there is no certificate.
std::vector<double> cell_indicators(Run& run, const MeshSolution& solution,
                                    const std::optional<Certificate>& certificate) {
  const RunStatistics::Phase phase(run.statistics, "indicator");
  if (certificate && run.options.mesh.indicator == Indicator::certificate)
    return certificate->cell_bounds;
  return kelly_indicator(solution.boundary.space(), solution.displacement);
}

/// The part of the error that may stay, as its bound estimates it; 0 without a target, or where
/// the bound does not give the indicators.
double goal_of(const RunOptions& options, const std::optional<Certificate>& certificate) {
  return certificate && options.mesh.indicator == Indicator::certificate
             ? options.mesh.wanted_relative_error / certificate->error.relative
             : 0;
}

/// sqrt(sum eta_K^2) over the cells of all processes.
double l2_norm(const std::vector<double>& indicators, MPI_Comm communicator) {
  const double squared =
      std::inner_product(indicators.begin(), indicators.end(), indicators.begin(), 0.);
  return std::sqrt(Utilities::MPI::sum(squared, communicator));
}

CycleFigures describe_cycle(const RingSpace& space, const MeshSolution& solution,
                            const std::optional<Certificate>& certificate) {
  CycleFigures cycle = {
      static_cast<unsigned int>(space.dof_handler().get_triangulation().n_global_active_cells()),
      space.n_unknowns(), static_cast<unsigned int>(solution.result.history.size()),
      solution.scene.road.distance, solution.result.contact.loads.vertical};
  if (certificate) {
    cycle.certified = certificate->error.relative;
    const Interval& load = certificate->error.loads.vertical;
    cycle.load_half_width = (load.upper - load.lower) / 2;
  }
  return cycle;
}

bool is_reached(const RunOptions& options, const std::optional<Certificate>& certificate) {
  return certificate && certificate->error.relative <= options.mesh.wanted_relative_error;
}

/// The number of the mesh with the least bound of the error, from 0 on; the last of equal ones.
unsigned int best_mesh(const std::vector<CycleFigures>& cycles) {
  const auto best = std::min_element(
      cycles.rbegin(), cycles.rend(), [](const CycleFigures& one, const CycleFigures& other) {
        return one.certified.value_or(0) < other.certified.value_or(0);
      });
  return cycles.rend() - best - 1;
}

/// True if refinement towards a wanted error gets nowhere: no bound is finite after many meshes, or
/// the least one is of a mesh long before.
bool has_stalled(const RunOptions& options, const std::vector<CycleFigures>& cycles) {
  constexpr unsigned int most_without_bound = 40, most_without_gain = 8;
  const unsigned int n_meshes = cycles.size(), best = best_mesh(cycles);
  const bool has_bound = std::isfinite(cycles[best].certified.value_or(0));
  return options.mesh.wanted_relative_error > 0 &&
         (has_bound ? n_meshes - 1 - best >= most_without_gain : n_meshes >= most_without_bound);
}

/// True if no further mesh is needed or allowed: the wanted error is reached, or will not be, the
/// cycles are used up, or the certificate has failed.
bool is_last(const Run& run, const std::optional<Certificate>& certificate,
             unsigned int most_refinements) {
  const bool has_failed = run.options.certificate.error_bound && !certificate;
  return has_failed || run.cycles.size() > most_refinements ||
         is_reached(run.options, certificate) || has_stalled(run.options, run.cycles);
}

/// Computes the stiffness of the loads, where the mesh resolves it.
void add_stiffness(const MeshObjects& objects, MeshSolution& solution, RunStatistics& statistics) {
  const RunStatistics::Phase phase(statistics, "measurement");
  attempt(
      [&] {
        solution.result.contact.stiffness = contact_stiffness(
            contact_equations(objects.system, objects.load.get(), solution.boundary), solution,
            statistics);
      },
      "the stiffness could not be computed", "use cells that are less stretched",
      solution.boundary.space().communicator(), solution.result.notes);
}

/// Solves, certifies and refines until the wanted error is reached, or cannot be.
/// @param run with its first mesh
LastSolution solve_and_refine(Run& run, Scene scene, unsigned int most_refinements,
                              const Progress& progress) {
  const RunOptions& options = run.options;
  PressureProfile pressure; // on the mesh before
  for (;;) {
    MeshObjects objects = {make_system(*run.mesh.space, scene, scene.zone(), run.statistics)};
    objects.load = make_load(objects.system, scene, run.statistics);
    MeshSolution solution = solve_on_mesh(objects, scene, options.contact, pressure, run.statistics,
                                          progress.contact_step_ended);
    objects.system.factor.reset(); // the certificate needs its memory
    objects.system.condensed->free_factors();
    std::optional<Certificate> certificate = certify_solution(run, objects, solution);
    objects.dual.reset();
    run.cycles.push_back(describe_cycle(*run.mesh.space, solution, certificate));
    CycleFigures& cycle = run.cycles.back();

    const bool ends = is_last(run, certificate, most_refinements);
    const bool is_stopped = !ends && !run.is_repeated && is_interrupted(run.mesh.communicator());
    if (is_stopped)
      solution.result.notes.push_back(
          {Note::Kind::shortfall, "interrupted on mesh " + std::to_string(run.cycles.size())});
    bool goes_on = !ends && !is_stopped;
    if (goes_on) {
      if (!scene.has_distance())
        scene = with_distance(scene, solution.scene.road.distance);
      pressure = pressure_profile(solution);
      const auto indicators = cell_indicators(run, solution, certificate);
      cycle.indicated = l2_norm(indicators, run.mesh.communicator());
      goes_on = refine(run.mesh, indicators, goal_of(options, certificate), scene, options,
                       run.statistics);
    }
    if (progress.mesh_solved && (goes_on || run.cycles.size() > 1))
      progress.mesh_solved(run.cycles.size(), cycle);
    if (!goes_on) {
      add_stiffness(objects, solution, run.statistics);
      return {std::move(solution), std::move(certificate), is_stopped};
    }
  }
}

/// Where the last mesh of a run towards a wanted error has a larger bound than an earlier one,
/// makes that one again: it is cheaper than to keep a copy of each.
Solution solve_best(Solution last, const Scene& scene, const RunOptions& options) {
  constexpr double margin = 1.05; // for less, it is not worth a second run
  const std::vector<CycleFigures> cycles = last.result.cycles;
  const unsigned int best = best_mesh(cycles);
  if (!(options.mesh.wanted_relative_error > 0) || last.result.is_interrupted ||
      !(cycles.back().certified.value_or(0) > margin * cycles[best].certified.value_or(0)))
    return last;
  const MPI_Comm communicator = last.mesh.communicator();
  RunStatistics statistics = std::move(last.result.statistics);
  { const Solution freed = std::move(last); }
  Mesh mesh = make_mesh(scene, options, communicator, statistics);
  Run run = {options, std::move(mesh), std::move(statistics)};
  run.is_repeated = true;
  LastSolution on_best = solve_and_refine(run, scene, best, {});
  Solution solution = finish(std::move(run), std::move(on_best));
  solution.result.notes.push_back(
      {Note::Kind::remark, "further meshes had larger bounds, up to " +
                               rounded(*cycles.back().certified, 3) + " on mesh " +
                               std::to_string(cycles.size()) + "; the result is that of mesh " +
                               std::to_string(best + 1)});
  return solution;
}

} // namespace

Solution simulate(const Scene& scene, const RunOptions& options, MPI_Comm communicator,
                  const Progress& progress) {
  check_simulation(scene, options);
  RunStatistics statistics(progress.phase_ended);
  Mesh mesh = make_mesh(scene, options, communicator, statistics);
  if (is_interrupted(communicator))
    throw Interrupted("interrupted before the first mesh was solved");
  Run run = {options, std::move(mesh), std::move(statistics)};
  std::optional<LastSolution> last;
  try {
    last.emplace(solve_and_refine(run, scene, most_cycles(options.mesh), progress));
  } catch (const NotEnoughMemory& shortage) {
    if (run.cycles.empty())
      throw;
    const std::string solved = std::to_string(run.cycles.back().n_unknowns);
    throw NotSolved("after a mesh of " + solved + " unknowns: " + shortage.reason +
                    "; set Mesh/Most unknowns to " + solved + " to end there");
  }
  return solve_best(finish(std::move(run), std::move(*last)), scene, options);
}

Solution solve_on_shared(Run run, MeshObjects& shared, const Scene& scene) {
  if (is_interrupted(run.mesh.communicator()))
    throw Interrupted("interrupted before the mesh was solved");
  MeshSolution solution = solve_on_mesh(shared, scene, run.options.contact, {}, run.statistics);
  std::optional<Certificate> certificate = certify_solution(run, shared, solution);
  run.cycles = {describe_cycle(*run.mesh.space, solution, certificate)};
  add_stiffness(shared, solution, run.statistics);
  return finish(std::move(run), {std::move(solution), std::move(certificate)});
}

} // namespace rollwave
