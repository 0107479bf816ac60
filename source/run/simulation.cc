#include "rollwave/run/simulation.h"

#include "rollwave/adapt/marking.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/interrupt.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/mesh/ring_mesh.h"
#include "rollwave/run/attempt.h"
#include "rollwave/run/load_bounds.h"
#include "rollwave/run/remarks.h"
#include "rollwave/run/solve_on_mesh.h"

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
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

/// The pressure of the mesh before at the nodes of another, zero outside of the contact. Without
/// entries when there was no mesh before.
Vector<double> carry_pressure(const Result& before, const std::vector<SurfaceNode>& nodes) {
  if (before.contact_rows.empty())
    return {};
  Vector<double> pressure(nodes.size());
  const auto& ends = before.patch.ends;
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (const double z = nodes[i].angle; ends && ends->first <= z && z <= ends->second)
      pressure(i) = pressure_at(before.contact_rows, z);
  return pressure;
}

/// Certifies the solution on a mesh, unless that fails.
void certify_solution(const MeshSolution& on_mesh, Solution& solution) {
  Result& result = solution.result;
  const Scene& scene = on_mesh.scene;
  const bool is_certified = attempt(
      [&] {
        solution.certificate =
            certify(*solution.space, scene, on_mesh.problem, on_mesh.contact, on_mesh.displacement,
                    solution.system.force.get(),
                    solution.system.dual_of(scene, *solution.space, result.work), result.work);
      },
      "the error could not be certified",
      "use fewer unknowns, or set Certificate/Error bound to false", solution.space->communicator(),
      result);
  if (!is_certified)
    return;
  result.certified = solution.certificate->error;
  result.cycles.back().certified = solution.certificate->error.relative;
}

/// eta_K of each active cell: its share of the bound or, where there is none, Kelly's indicator.
std::vector<double> indicate(const RunOptions& options, const MeshSolution& on_mesh,
                             Solution& solution) {
  const Work::Phase phase(solution.result.work, "indicator");
  const bool has_bound = options.certificate.error_bound;
  std::vector<double> of_cells = has_bound && options.mesh.indicator == Indicator::certificate
                                     ? solution.certificate->cell_bounds
                                     : kelly_indicator(*solution.space, on_mesh.displacement);
  const double squared = std::inner_product(of_cells.begin(), of_cells.end(), of_cells.begin(), 0.);
  solution.result.cycles.back().indicated =
      std::sqrt(Utilities::MPI::sum(squared, solution.space->communicator()));
  return of_cells;
}

double most_cells(const RunOptions& options) {
  const auto& mesh = options.mesh;
  return mesh.most_unknowns / (1. * mesh.degree * mesh.degree);
}

/// Refines where @p indicators are large; what belongs to the old mesh is dropped. False, and
/// nothing is changed, when the mesh would get too large or no cell is marked.
bool refine(const std::vector<double>& indicators, const RunOptions& options, Solution& solution) {
  const Work::Phase phase(solution.result.work, "mesh");
  const auto& mesh = options.mesh;
  if (!refine_mesh(*solution.triangulation, solution.scene, indicators, mesh.marking,
                   mesh.marked_fraction, most_cells(options)))
    return false;
  solution.certificate.reset();
  solution.system = {};
  solution.space.reset();
  solution.result.certified.reset();
  return true;
}

bool is_reached(const RunOptions& options, const Result& result) {
  return result.certified && result.certified->relative <= options.mesh.wanted_relative_error;
}

/// Bounds the work-conjugate load or, where that is given, the distance.
void enclose_load(const RunOptions& options, const MeshSolution& on_mesh, Solution& solution) {
  Result& result = solution.result;
  if (!solution.scene.load)
    result.load_bounds = bound_load(options, *solution.space, on_mesh, solution.system, result);
  else if (solution.scene.load->kind == LoadKind::work_conjugate)
    result.distance_bounds =
        bound_distance(options, *solution.space, on_mesh, solution.system, result);
  else
    result.remarks.push_back("the distance can be enclosed where Road/Load kind is work-conjugate "
                             "only");
}

/// Completes the result of the last mesh.
void finish(const RunOptions& options, MeshSolution on_mesh, Solution& solution) {
  Result& result = solution.result;
  const auto& certificate = options.certificate;
  if (options.mesh.wanted_relative_error > 0 && result.certified && !is_reached(options, result))
    result.shortfalls.push_back(
        missing_error_text(options, result, is_at_finest_level(*solution.triangulation)));
  else if (result.shortfalls.empty() && result.residuals.largest() > wanted_residual &&
           options.contact.method == ContactMethod::active_set)
    result.shortfalls.push_back(residual_text(result.residuals));
  if (certificate.load_bounds && result.certified && !result.is_interrupted)
    attempt([&] { enclose_load(options, on_mesh, solution); }, "the load could not be enclosed",
            "use fewer unknowns, or set Certificate/Load bounds to false",
            solution.space->communicator(), result);
  for (const std::string& remark : remarks_on(solution.scene, options, *solution.space, result))
    result.remarks.push_back(remark);
  solution.displacement = std::move(on_mesh.displacement);
}

/// Indicates and refines. False, and the mesh is the last one, when what is wanted is reached, or
/// cannot be, or the user has interrupted it.
bool refine_further(const RunOptions& options, const MeshSolution& on_mesh, Solution& solution) {
  Result& result = solution.result;
  const bool is_certified = solution.certificate || !options.certificate.error_bound;
  if (result.is_interrupted || result.cycles.size() > most_cycles(options.mesh) || !is_certified ||
      is_reached(options, result) ||
      !has_room_to_refine(*solution.triangulation, options.mesh.marking, most_cells(options)))
    return false;
  const std::vector<double> indicators = indicate(options, on_mesh, solution);
  result.is_interrupted = is_interrupted(solution.space->communicator());
  if (result.is_interrupted)
    result.shortfalls.push_back("interrupted after " + std::to_string(result.cycles.size()) +
                                (result.cycles.size() == 1 ? " mesh" : " meshes"));
  return !result.is_interrupted && refine(indicators, options, solution);
}

/// Makes the space of the mesh, or takes that of another scene on it.
void prepare_space(const RunOptions& options, Solution& solution) {
  const Work::Phase phase(solution.result.work, "space");
  if (solution.space)
    solution.space->set_contact_zone(solution.scene);
  else
    solution.space =
        std::make_unique<RingSpace>(*solution.triangulation, solution.scene, options.mesh.degree);
}

/// Solves, certifies and refines until what @p options want is reached, or cannot be. @p solution
/// has a mesh, and perhaps the contact of a coarser one. @param is_kept whether what belongs to the
/// last mesh will be used again
void solve_and_refine(const RunOptions& options, bool is_kept, Solution& solution) {
  Result& result = solution.result;
  for (;;) {
    prepare_space(options, solution);
    MeshSolution on_mesh = solve_on_mesh(solution.scene, options, *solution.space,
                                         carry_pressure(result, solution.space->contact_nodes()),
                                         solution.system, result.work);
    solution.scene = on_mesh.scene;
    measure(*solution.space, on_mesh, result);
    if (!is_kept && !options.certificate.load_bounds)
      solution.system.stiffness.solver.reset(); // the certificate needs its memory
    if (options.certificate.error_bound)
      certify_solution(on_mesh, solution);
    if (refine_further(options, on_mesh, solution))
      continue;
    finish(options, std::move(on_mesh), solution);
    if (!is_kept)
      solution.system = {};
    return;
  }
}

/// Whether the first contact iteration begins on a coarser mesh: each of its steps costs the
/// iterative kind a new preconditioner.
bool begins_coarser(const RunOptions& options, MPI_Comm communicator) {
  constexpr double least_unknowns = 1e5;
  return (options.solver.kind == SolverKind::iterative || !is_alone(communicator)) &&
         options.contact.method == ContactMethod::active_set &&
         count_unknowns(options.mesh) > least_unknowns;
}

} // namespace

Solution simulate(const Scene& scene, const RunOptions& options, MPI_Comm communicator,
                  std::optional<Solution> previous) {
  check_simulation(options, count_processes(communicator));
  Solution solution;
  solution.scene = scene;
  if (previous) {
    solution.triangulation = std::move(previous->triangulation);
    solution.space = std::move(previous->space);
    solution.system = std::move(previous->system);
  }
  if (begins_coarser(options, communicator))
    try {
      Solution start = simulate(scene, coarser(options), communicator);
      solution.scene = std::move(start.scene);
      solution.result.work = start.result.work;
      solution.result.contact_rows = std::move(start.result.contact_rows);
      solution.result.patch = std::move(start.result.patch);
    } catch (const Interrupted&) {
      throw;
    } catch (const BadInput&) {
      // Too coarse for this scene, such as for a short zone: then without a start.
    } catch (const NotSolved&) {
      // Likewise.
    }
  if (!solution.triangulation) {
    const Work::Phase phase(solution.result.work, "mesh");
    solution.triangulation =
        make_ring_mesh(scene, options.mesh, most_cycles(options.mesh) > 0, communicator);
  }
  if (is_interrupted(communicator))
    throw Interrupted("interrupted before the first mesh was solved");
  try {
    solve_and_refine(options, previous.has_value(), solution);
  } catch (const NotEnoughMemory& shortage) {
    if (solution.result.cycles.empty())
      throw;
    const std::string solved = std::to_string(solution.result.cycles.back().dofs);
    throw NotSolved("after a mesh of " + solved + " unknowns: " + shortage.reason +
                    "; set Mesh/Most unknowns to " + solved + " to end there");
  }
  return solution;
}

} // namespace rollwave
