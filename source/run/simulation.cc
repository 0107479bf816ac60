#include "rollwave/run/simulation.h"

#include "rollwave/adapt/marking.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/interrupt.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/contact/load_control.h"
#include "rollwave/mesh/ring_mesh.h"
#include "rollwave/run/attempt.h"
#include "rollwave/run/measure.h"
#include "rollwave/run/remarks.h"
#include "rollwave/run/solve_on_mesh.h"

#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace rollwave {

using namespace dealii;

void check_simulation(const RunOptions& options, unsigned int n_processes) {
  if (options.solver.kind == SolverKind::direct && n_processes > 1)
    throw BadValue("Solver", "Kind",
                   "the direct kind needs one process; on several use auto or iterative");
  check_mesh_size(options.mesh);
}

namespace {

/// The certificate of a solution, where it is wanted and does not fail.
std::optional<Certificate> certify_solution(const RunOptions& options, Discretisation& mesh,
                                            MeshSolution& solution, RunStatistics& statistics) {
  std::optional<Certificate> certificate;
  if (options.certificate.error_bound)
    attempt([&] { certificate = certify(solution, mesh.cache, statistics); },
            "the error could not be certified",
            "use fewer unknowns, or set Certificate/Error bound to false", mesh.communicator(),
            solution.shortfalls);
  return certificate;
}

/// eta_K of each active cell by Mesh/Indicator; Kelly's if there is no certificate.
std::vector<double> cell_indicators(const RunOptions& options, const Discretisation& mesh,
                                    const MeshSolution& solution,
                                    const std::optional<Certificate>& certificate,
                                    RunStatistics& statistics) {
  const RunStatistics::Phase phase(statistics, "indicator");
  if (certificate && options.mesh.indicator == Indicator::certificate)
    return certificate->cell_bounds;
  return kelly_indicator(*mesh.space, solution.displacement);
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
  if (certificate)
    cycle.certified = certificate->error.relative;
  return cycle;
}

bool is_reached(const RunOptions& options, const std::optional<Certificate>& certificate) {
  return certificate && certificate->error.relative <= options.mesh.wanted_relative_error;
}

/// True if a work-conjugate load is given that @p n_meshes do not resolve: finer ones do not
/// either.
bool is_load_beyond_meshes(const MeshSolution& solution, unsigned int n_meshes) {
  constexpr unsigned int enough = 60;
  const auto& load = solution.scene.load;
  return load && load->kind == LoadKind::work_conjugate && n_meshes >= enough &&
         reaches_tangent(solution.problem, solution.contact.active);
}

/// True if no further mesh is needed or possible: the wanted error is reached, the cycles or the
/// room are used up, the certificate has failed, or finer meshes do not resolve the load either.
bool is_last(const RunOptions& options, const Discretisation& mesh, const MeshSolution& solution,
             const std::optional<Certificate>& certificate, unsigned int n_meshes) {
  const bool has_failed = options.certificate.error_bound && !certificate;
  return has_failed || is_load_beyond_meshes(solution, n_meshes) ||
         n_meshes > most_cycles(options.mesh) || is_reached(options, certificate) ||
         !has_room_to_refine(*mesh.triangulation, options.mesh, most_cells(options));
}

std::string interrupted_text(unsigned int n_meshes) {
  return "interrupted after " + std::to_string(n_meshes) + (n_meshes == 1 ? " mesh" : " meshes");
}

/// Adds the targets that were not reached, and the remarks.
void add_shortfalls_and_remarks(const RunOptions& options, const Discretisation& mesh,
                                const MeshSolution& solution,
                                const std::optional<Certificate>& certificate, Result& result) {
  const bool wants_error = options.mesh.wanted_relative_error > 0;
  if (wants_error && certificate && !is_reached(options, certificate) &&
      !is_load_beyond_meshes(solution, result.cycles.size()))
    result.shortfalls.push_back(
        missing_error_text(options, result, is_at_finest_level(*mesh.triangulation)));
  else if (result.shortfalls.empty() && result.residuals.largest() > result.residuals.allowed &&
           options.contact.method == ContactMethod::active_set)
    result.shortfalls.push_back(residual_text(result.residuals));
  for (const std::string& remark : remarks_on(options, solution, result))
    result.remarks.push_back(remark);
}

/// The solution of a run from that on its last mesh.
Solution finish(const RunOptions& options, Discretisation mesh, MeshSolution last,
                std::optional<Certificate> certificate, std::vector<CycleFigures> cycles,
                bool is_interrupted, RunStatistics statistics) {
  Result result = measure(last);
  result.cycles = std::move(cycles);
  result.is_interrupted = is_interrupted;
  if (certificate)
    result.certified = certificate->error;
  add_shortfalls_and_remarks(options, mesh, last, certificate, result);
  if (!mesh.is_shared)
    mesh.cache = {};
  result.statistics = std::move(statistics);
  return {last.scene, std::move(mesh), std::move(last.displacement), std::move(certificate),
          std::move(result)};
}

/// Solves, certifies and refines until the wanted error is reached, or cannot be.
/// @param pressure to start from
Solution solve_and_refine(Discretisation mesh, Scene scene, const RunOptions& options,
                          PressureProfile pressure, RunStatistics statistics,
                          const Progress& progress, std::vector<CycleFigures>& cycles) {
  for (;;) {
    MeshSolution solution = solve_on_mesh(scene, options, mesh.candidates, pressure, mesh.cache,
                                          statistics, progress.contact_step_ended);
    if (!mesh.is_shared)
      mesh.cache.stiffness.solver.reset(); // the certificate needs its memory
    std::optional<Certificate> certificate = certify_solution(options, mesh, solution, statistics);
    cycles.push_back(describe_cycle(*mesh.space, solution, certificate));

    const bool ends = is_last(options, mesh, solution, certificate, cycles.size());
    const bool is_stopped = !ends && is_interrupted(mesh.communicator());
    if (is_stopped)
      solution.shortfalls.push_back(interrupted_text(cycles.size()));
    bool goes_on = !ends && !is_stopped;
    if (goes_on) {
      scene = solution.scene;
      pressure = pressure_profile(solution);
      const auto indicators = cell_indicators(options, mesh, solution, certificate, statistics);
      cycles.back().indicated = l2_norm(indicators, mesh.communicator());
      goes_on = mesh.refine(indicators, scene, options, statistics);
    }
    if (progress.mesh_solved && (goes_on || cycles.size() > 1))
      progress.mesh_solved(cycles.size(), cycles.back());
    if (!goes_on)
      return finish(options, std::move(mesh), std::move(solution), std::move(certificate), cycles,
                    is_stopped, std::move(statistics));
  }
}

/// True if the first contact iteration begins on a coarser mesh: each of its steps costs the
/// iterative kind a new preconditioner.
bool begins_coarser(const RunOptions& options, MPI_Comm communicator) {
  constexpr double least_unknowns = 1e5;
  return (options.solver.kind == SolverKind::iterative || !is_serial(communicator)) &&
         options.contact.method == ContactMethod::active_set &&
         count_unknowns(options.mesh) > least_unknowns;
}

/// A start from a coarser mesh.
struct Start {
  Scene scene; ///< with the distance found there
  PressureProfile pressure;
};

/// Solves on a coarser mesh. If that fails, such as for a short zone, returns the scene unchanged
/// and no pressure.
Start solve_coarser(const Scene& scene, const RunOptions& options, MPI_Comm communicator,
                    RunStatistics& statistics) {
  try {
    const RunOptions coarse = coarser(options);
    Discretisation mesh(scene, coarse, communicator, statistics);
    const MeshSolution solution =
        solve_on_mesh(scene, coarse, mesh.candidates, {}, mesh.cache, statistics);
    return {solution.scene, pressure_profile(solution)};
  } catch (const BadInput&) {
    return {scene, {}};
  } catch (const NotSolved&) {
    return {scene, {}};
  }
}

} // namespace

Solution simulate(Discretisation mesh, const Scene& scene, const RunOptions& options,
                  RunStatistics statistics, const Progress& progress) {
  const MPI_Comm communicator = mesh.communicator();
  Start start = {scene, {}};
  if (begins_coarser(options, communicator))
    start = solve_coarser(scene, options, communicator, statistics);
  if (is_interrupted(communicator))
    throw Interrupted("interrupted before the first mesh was solved");
  std::vector<CycleFigures> cycles;
  try {
    return solve_and_refine(std::move(mesh), start.scene, options, std::move(start.pressure),
                            std::move(statistics), progress, cycles);
  } catch (const NotEnoughMemory& shortage) {
    if (cycles.empty())
      throw;
    const std::string solved = std::to_string(cycles.back().n_unknowns);
    throw NotSolved("after a mesh of " + solved + " unknowns: " + shortage.reason +
                    "; set Mesh/Most unknowns to " + solved + " to end there");
  }
}

Solution simulate(const Scene& scene, const RunOptions& options, MPI_Comm communicator,
                  const Progress& progress) {
  check_simulation(options, count_processes(communicator));
  RunStatistics statistics(progress.phase_ended);
  Discretisation mesh(scene, options, communicator, statistics);
  return simulate(std::move(mesh), scene, options, std::move(statistics), progress);
}

} // namespace rollwave
