#include "rollwave/run/simulation.h"

#include "rollwave/adapt/marking.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/interrupt.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/text.h"
#include "rollwave/contact/load_control.h"
#include "rollwave/mesh/ring_mesh.h"
#include "rollwave/run/attempt.h"
#include "rollwave/run/make_result.h"
#include "rollwave/run/solve_on_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
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
/// @param dual is made if it is not there yet
std::optional<Certificate> certify_solution(const RunOptions& options, const Load* load,
                                            std::unique_ptr<const DualSystem>& dual,
                                            MeshSolution& solution, RunStatistics& statistics) {
  std::optional<Certificate> certificate;
  if (!options.certificate.error_bound)
    return certificate;
  const RunStatistics::Phase phase(statistics, "certificate");
  const RingSpace& space = solution.boundary.space();
  attempt(
      [&] {
        if (!dual)
          dual = std::make_unique<DualSystem>(space, solution.scene, statistics);
        certificate =
            certify(solution.boundary, solution.scene, solution.contact, solution.displacement,
                    load ? &load->integral : nullptr, *dual, statistics);
      },
      "the error could not be certified",
      "use fewer unknowns, or set Certificate/Error bound to false", space.communicator(),
      solution.notes);
  return certificate;
}

/// eta_K of each active cell by Mesh/Indicator; Kelly's if there is no certificate.
std::vector<double> cell_indicators(const RunOptions& options, const MeshSolution& solution,
                                    const std::optional<Certificate>& certificate,
                                    RunStatistics& statistics) {
  const RunStatistics::Phase phase(statistics, "indicator");
  if (certificate && options.mesh.indicator == Indicator::certificate)
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
      space.n_unknowns(),
      static_cast<unsigned int>(solution.contact.history.size()),
      solution.scene.road.distance,
      solution.resultants.loads.vertical,
      0,
      {}};
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
bool is_last(const RunOptions& options, const std::optional<Certificate>& certificate,
             const std::vector<CycleFigures>& cycles, unsigned int most_refinements) {
  const bool has_failed = options.certificate.error_bound && !certificate;
  return has_failed || cycles.size() > most_refinements || is_reached(options, certificate) ||
         has_stalled(options, cycles);
}

std::string interrupted_text(unsigned int n_meshes) {
  return "interrupted after " + std::to_string(n_meshes) + (n_meshes == 1 ? " mesh" : " meshes");
}

/// Computes the stiffness of the loads, where the mesh resolves it.
void add_stiffness(const System& system, const Load* load, MeshSolution& solution,
                   RunStatistics& statistics) {
  constexpr unsigned int no_limit = std::numeric_limits<unsigned int>::max();
  const RunStatistics::Phase phase(statistics, "measurement");
  attempt(
      [&] {
        solution.resultants.stiffness = contact_stiffness(
            contact_equations(system, load, solution.boundary), solution.boundary, solution.scene,
            solution.problem, solution.contact, no_limit, statistics);
      },
      "the stiffness could not be computed", "use cells that are less stretched",
      solution.boundary.space().communicator(), solution.notes);
}

/// The solution of a run from that on its last mesh. @throws BadValue for a load or a nip out of
/// reach
Solution finish(const RunOptions& options, Mesh mesh, MeshSolution last,
                std::optional<Certificate> certificate, std::vector<CycleFigures> cycles,
                bool is_interrupted, RunStatistics statistics) {
  if (last.road_refusal)
    throw BadValue("Road", last.scene.nip ? "Nip" : "Load", *last.road_refusal);
  Result result = make_result(options, mesh, last, certificate, std::move(cycles), is_interrupted,
                              std::move(statistics));
  return {last.scene, std::move(mesh), std::move(last.displacement), std::move(certificate),
          std::move(result)};
}

/// Solves, certifies and refines until the wanted error is reached, or cannot be.
Solution solve_and_refine(Mesh mesh, Scene scene, const RunOptions& options,
                          unsigned int most_refinements, RunStatistics statistics,
                          const Progress& progress, std::vector<CycleFigures>& cycles) {
  PressureProfile pressure; // on the mesh before
  for (;;) {
    System system = make_system(*mesh.space, scene, scene.zone(), statistics);
    const std::unique_ptr<const Load> load = make_load(system, scene, statistics);
    MeshSolution solution = solve_on_mesh(system, load.get(), scene, options.contact, pressure,
                                          statistics, progress.contact_step_ended);
    system.factor.reset(); // the certificate needs its memory
    system.condensed->free_factors();
    std::unique_ptr<const DualSystem> dual;
    std::optional<Certificate> certificate =
        certify_solution(options, load.get(), dual, solution, statistics);
    dual.reset();
    cycles.push_back(describe_cycle(*mesh.space, solution, certificate));

    const bool ends = is_last(options, certificate, cycles, most_refinements);
    const bool is_stopped = !ends && is_interrupted(mesh.communicator());
    if (is_stopped)
      solution.notes.push_back({Note::Kind::shortfall, interrupted_text(cycles.size())});
    bool goes_on = !ends && !is_stopped;
    if (goes_on) {
      scene = solution.scene;
      pressure = pressure_profile(solution);
      const auto indicators = cell_indicators(options, solution, certificate, statistics);
      cycles.back().indicated = l2_norm(indicators, mesh.communicator());
      goes_on = refine(mesh, indicators, goal_of(options, certificate), scene, options, statistics);
    }
    if (progress.mesh_solved && (goes_on || cycles.size() > 1))
      progress.mesh_solved(cycles.size(), cycles.back());
    if (!goes_on) {
      add_stiffness(system, load.get(), solution, statistics);
      return finish(options, std::move(mesh), std::move(solution), std::move(certificate), cycles,
                    is_stopped, std::move(statistics));
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
  std::vector<CycleFigures> again;
  Solution solution =
      solve_and_refine(std::move(mesh), scene, options, best, std::move(statistics), {}, again);
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
  std::vector<CycleFigures> cycles;
  try {
    return solve_best(solve_and_refine(std::move(mesh), scene, options, most_cycles(options.mesh),
                                       std::move(statistics), progress, cycles),
                      scene, options);
  } catch (const NotEnoughMemory& shortage) {
    if (cycles.empty())
      throw;
    const std::string solved = std::to_string(cycles.back().n_unknowns);
    throw NotSolved("after a mesh of " + solved + " unknowns: " + shortage.reason +
                    "; set Mesh/Most unknowns to " + solved + " to end there");
  }
}

Solution solve_on_shared(Mesh mesh, SharedObjects& shared, const Scene& scene,
                         const RunOptions& options, RunStatistics statistics) {
  if (is_interrupted(mesh.communicator()))
    throw Interrupted("interrupted before the mesh was solved");
  const Load* const load = shared.load.get();
  MeshSolution solution =
      solve_on_mesh(shared.system, load, scene, options.contact, {}, statistics);
  std::optional<Certificate> certificate =
      certify_solution(options, load, shared.dual, solution, statistics);
  const auto cycle = describe_cycle(*mesh.space, solution, certificate);
  add_stiffness(shared.system, load, solution, statistics);
  return finish(options, std::move(mesh), std::move(solution), std::move(certificate), {cycle},
                /*is_interrupted=*/false, std::move(statistics));
}

} // namespace rollwave
