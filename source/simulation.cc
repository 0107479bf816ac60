#include "simulation.h"

#include "certificate_preparation.h"
#include "errors.h"
#include "interrupt.h"
#include "load_bounds.h"
#include "memory.h"
#include "mesh_solution.h"
#include "processes.h"
#include "refinement.h"
#include "remarks.h"
#include "residual_indicator.h"
#include "ring_mesh.h"
#include "task_beside.h"

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace rollwave {

using namespace dealii;

void check_simulation(const Parameters& parameters, unsigned int n_processes) {
  if (parameters.solver.kind == SolverKind::direct && n_processes > 1)
    throw BadInput(refusal(parameters.settings, "Solver", "Kind",
                           "the direct kind needs one process; on several use auto or iterative"));
  check_mesh_size(parameters);
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

/// Adds what else there is to say.
void add_text(std::string& text, const std::string& more) {
  text += (text.empty() || more.empty() ? "" : "; ") + more;
}

/// Why something was not solved. For want of memory there is other advice than the exception's.
std::string reason_of(const NotSolved& failure) {
  const auto* const shortage = dynamic_cast<const NotEnoughMemory*>(&failure);
  return shortage ? shortage->reason : failure.what();
}

/// What is left out for a failure, and the key that leaves it out from the start.
std::string left_out_text(const std::string& what, const NotSolved& failure,
                          const std::string& key) {
  return what + ": " + reason_of(failure) + "; use fewer unknowns, or set " + key + " to false";
}

/// A certificate that fails, such as for want of memory, leaves the solution as it is, with a
/// shortfall. Where an error is wanted and the mesh before was certified, this one counts as not
/// solved.
/// @throws NotSolved then.
void certify_solution(const Scene& scene, const MeshSolution& on_mesh, bool wants_error,
                      std::optional<CertificatePreparation>& preparation, Solution& solution) {
  Result& result = solution.result;
  try {
    if (preparation)
      preparation->finish();
    solution.certificate = certify(*solution.space, scene, on_mesh.problem, on_mesh.contact,
                                   on_mesh.displacement, solution.system, result.work);
  } catch (const NotSolved& failure) {
    if (wants_error && result.cycles.size() > 1) {
      result.cycles.pop_back();
      throw;
    }
    solution.system = {};
    add_text(result.shortfall,
             left_out_text("the error could not be certified", failure, "Certificate/Error bound"));
    return;
  }
  result.certified = solution.certificate->error;
  result.cycles.back().certified = solution.certificate->error.relative;
}

/// eta_K of each active cell.
std::vector<double> indicate(Indicator indicator, const Scene& scene, const MeshSolution& on_mesh,
                             Solution& solution) {
  const Work::Phase phase(solution.result.work, "indicator");
  return indicator == Indicator::kelly ? kelly_indicator(*solution.space, on_mesh.displacement)
                                       : residual_indicator(*solution.space, scene, on_mesh.problem,
                                                            on_mesh.contact, on_mesh.displacement);
}

/// The indicator or, where that is larger, the cell's part of the bound: a load that is rough
/// beyond some cells is so in G on them, which their residuals do not see.
std::vector<double> larger_of(std::vector<double> indicators, const Certificate& certificate) {
  for (unsigned int i = 0; i < indicators.size(); ++i)
    indicators[i] = std::max(indicators[i], certificate.cell_bounds[i]);
  return indicators;
}

double most_cells(const Parameters& parameters) {
  const auto& mesh = parameters.mesh;
  return mesh.most_unknowns / (1. * mesh.degree * mesh.degree);
}

/// Refines where @p indicators are large; what belongs to the old mesh is dropped. False, and
/// nothing is changed, when the mesh would get too large or no cell is marked.
bool refine(const Scene& scene, const std::vector<double>& indicators, const Parameters& parameters,
            bool coarsens, Solution& solution) {
  const Work::Phase phase(solution.result.work, "mesh");
  const auto& mesh = parameters.mesh;
  if (!refine_mesh(*solution.triangulation, scene, indicators, mesh.marking, mesh.marked_fraction,
                   mesh.degree, most_cells(parameters), coarsens))
    return false;
  solution.certificate.reset();
  solution.system = {};
  solution.space.reset();
  solution.result.certified.reset();
  return true;
}

/// What of the wanted error is missing, if any is wanted.
std::string error_text(const Parameters& parameters, const Result& result) {
  std::ostringstream text;
  if (const double wanted = parameters.mesh.wanted_relative_error; wanted > 0 && result.certified)
    text << "the certified relative error is " << result.certified->relative << ", wanted "
         << wanted;
  return text.str();
}

/// Why not all was reached, and what to do.
std::string shortfall_text(const Parameters& parameters, const Solution& solution) {
  const Result& result = solution.result;
  std::string text = result.shortfall;
  if (text.empty() && result.is_interrupted)
    text = "interrupted after " + std::to_string(result.cycles.size()) +
           (result.cycles.size() == 1 ? " mesh" : " meshes");
  add_text(text, error_text(parameters, result));
  if (is_at_finest_level(*solution.triangulation))
    add_text(text, "the smallest cells cannot be cut again: raise Mesh/Radial cells and "
                   "Mesh/Angular cells, or want less");
  else if (result.shortfall.empty() && !result.is_interrupted)
    add_text(text, "raise Mesh/Most unknowns or Mesh/Adaptive cycles, or want less");
  return text;
}

std::string residual_text(const Residuals& residuals) {
  std::ostringstream text;
  text << "the conditions of contact and equilibrium hold to " << residuals.largest()
       << " only, wanted " << wanted_residual << "; rounding the displacement makes "
       << residuals.round_off
       << ": use fewer unknowns, cells that are less stretched, or a hub that is less small";
  return text.str();
}

/// Whether the first contact iteration begins on a coarser mesh: each of its steps costs the
/// iterative kind a new preconditioner.
bool begins_coarser(const Parameters& parameters, MPI_Comm communicator) {
  constexpr double least_unknowns = 1e5;
  return (parameters.solver.kind == SolverKind::iterative || !is_alone(communicator)) &&
         parameters.contact.method == ContactMethod::active_set &&
         count_unknowns(parameters) > least_unknowns;
}

/// The scene on a mesh with a sixteenth of the cells, for its pressure.
Parameters coarser(Parameters parameters) {
  auto& mesh = parameters.mesh;
  for (int halving = 0; halving < 2; ++halving)
    if (mesh.global_refinements > 0)
      --mesh.global_refinements;
    else {
      mesh.radial_cells = (mesh.radial_cells + 1) / 2;
      mesh.angular_cells = std::max(3u, (mesh.angular_cells + 1) / 2);
    }
  mesh.adaptive_cycles = 0;
  mesh.wanted_relative_error = 0;
  parameters.certificate = {};
  parameters.certificate.error_bound = false;
  return parameters;
}

/// Which parts of the linear problems are kept when they have been used.
enum class Keep { nothing, everything };

Solution run(const Scene& scene, const Parameters& parameters, MPI_Comm communicator,
             Solution previous, Keep keep);

/// Solves and refines until what @p parameters want is reached, or cannot be. @p solution has a
/// mesh, and a space on it if it continues another.
void solve_and_refine(const Scene& scene, const Parameters& parameters, const Result& before,
                      MPI_Comm communicator, Keep keep, Solution& solution) {
  const auto& mesh = parameters.mesh;
  const bool certifies = parameters.certificate.error_bound;
  const bool wants_error = mesh.wanted_relative_error > 0;
  const bool continues = solution.space != nullptr;
  Result& result = solution.result;
  for (unsigned int cycle = 0;; ++cycle) {
    if (!solution.space) {
      const Work::Phase phase(result.work, "space");
      solution.space = std::make_unique<RingSpace>(*solution.triangulation, scene, mesh.degree);
    }
    if (cycle == 0 && is_interrupted(communicator))
      throw Interrupted("interrupted before the first mesh was solved");
    const bool may_coarsen = continues && cycle == 0;
    const bool is_last = cycle == most_cycles(parameters) ||
                         (!may_coarsen && !has_room_to_refine(*solution.triangulation, mesh.marking,
                                                              most_cells(parameters)));
    const bool is_used_again = keep == Keep::everything ||
                               (parameters.certificate.load_bounds && most_cycles(parameters) == 0);
    // Its threads gain nothing there, and take the cores from others while they wait for more.
    std::optional<BlasOnOneThread> blas;
    if (solution.space->n_unknowns() < many_unknowns)
      blas.emplace();
    std::optional<CertificatePreparation> preparation;
    if (certifies && (is_last || wants_error) && gains_by_preparing(scene, parameters, solution)) {
      make_load(scene, parameters, *solution.space, solution.system, result.work);
      preparation.emplace(scene, solution);
    }
    MeshSolution on_mesh =
        solve_on_mesh(scene, parameters, *solution.space,
                      carry_pressure(cycle == 0 ? before : result, solution.space->contact_nodes()),
                      solution.system, result.work);
    measure(scene, *solution.space, on_mesh, result);
    result.is_interrupted = !result.shortfall.empty();
    solution.system.is_kept = is_used_again;
    if (!is_used_again)
      solution.system.stiffness.solver.reset();
    if (certifies && (is_last || wants_error))
      certify_solution(scene, on_mesh, wants_error, preparation, solution);
    const bool is_reached =
        wants_error && result.certified && result.certified->relative <= mesh.wanted_relative_error;
    const bool is_finished = is_reached || is_last || !result.shortfall.empty();
    if (!is_finished)
      result.is_interrupted = is_interrupted(communicator);
    if (!is_finished && !result.is_interrupted) {
      const std::vector<double> indicators = indicate(mesh.indicator, scene, on_mesh, solution);
      const bool is_baseline = mesh.indicator == Indicator::kelly;
      if (refine(scene,
                 solution.certificate && !is_baseline ? larger_of(indicators, *solution.certificate)
                                                      : indicators,
                 parameters, may_coarsen, solution)) {
        double squared = 0;
        for (const double eta : indicators)
          squared += eta * eta;
        result.cycles.back().indicated = std::sqrt(Utilities::MPI::sum(squared, communicator));
        continue;
      }
    }
    if (certifies && !is_last && !wants_error)
      certify_solution(scene, on_mesh, wants_error, preparation, solution);
    if (result.is_interrupted || (wants_error && !is_reached))
      result.shortfall = shortfall_text(parameters, solution);
    else if (result.shortfall.empty() && result.residuals.largest() > wanted_residual &&
             parameters.contact.method == ContactMethod::active_set)
      result.shortfall = residual_text(result.residuals);
    if (parameters.certificate.load_bounds && result.certified && !result.is_interrupted)
      try {
        result.load_bounds =
            bound_load(scene, parameters, *solution.space, on_mesh, solution.system, result);
      } catch (const NotSolved& failure) {
        add_text(result.shortfall, left_out_text("the load could not be enclosed", failure,
                                                 "Certificate/Load bounds"));
      }
    for (const std::string& remark : remarks_on(scene, parameters, result))
      result.remarks.push_back(remark);
    if (keep == Keep::nothing)
      solution.system = {};
    solution.displacement = std::move(on_mesh.displacement);
    return;
  }
}

/// Solves anew, on no larger meshes than the last of @p result, after one that failed for this
/// @p reason.
Solution run_on_smaller_meshes(const Scene& scene, Parameters parameters, MPI_Comm communicator,
                               const Result& result, const std::string& reason, Keep keep) {
  const unsigned int most_unknowns =
      std::max<unsigned int>(result.cycles.back().dofs, std::lround(count_unknowns(parameters)));
  parameters.mesh.most_unknowns = most_unknowns;
  Solution solution = run(scene, parameters, communicator, {}, keep);
  for (const auto& [phase, seconds] : result.work.seconds())
    solution.result.work.add_seconds(phase, seconds);
  if (!solution.result.is_interrupted) {
    std::string text = "a mesh of more than " + std::to_string(most_unknowns) +
                       " unknowns could not be solved: " + reason +
                       "; lower Mesh/Most unknowns to that, or want less";
    const bool lacks_certificate = parameters.certificate.error_bound && !solution.result.certified;
    add_text(text, lacks_certificate ? solution.result.shortfall
                                     : error_text(parameters, solution.result));
    solution.result.shortfall = text;
  }
  return solution;
}

Solution run(const Scene& scene, const Parameters& parameters, MPI_Comm communicator,
             Solution previous, Keep keep) {
  check_simulation(parameters, count_processes(communicator));

  Solution solution;
  solution.triangulation = std::move(previous.triangulation);
  solution.space = std::move(previous.space);
  solution.system = std::move(previous.system);
  // On a mesh that is not refined the steps of a contact iteration shall not depend on what was
  // solved before.
  Result before = most_cycles(parameters) > 0 ? std::move(previous.result) : Result();
  if (before.contact_rows.empty() && begins_coarser(parameters, communicator))
    try {
      before = run(scene, coarser(parameters), communicator, {}, Keep::nothing).result;
      solution.result.work = before.work;
    } catch (const Interrupted&) {
      throw;
    } catch (const BadInput&) {
      // Too coarse for this scene, such as for a short zone: then without a start.
    } catch (const NotSolved&) {
      // Likewise.
    }
  if (!solution.triangulation) {
    const Work::Phase phase(solution.result.work, "mesh");
    solution.triangulation = make_ring_mesh(scene, parameters, communicator);
  }
  std::string reason;
  try {
    solve_and_refine(scene, parameters, before, communicator, keep, solution);
    return solution;
  } catch (const NotSolved& failure) {
    if (solution.result.cycles.empty())
      throw;
    reason = reason_of(failure);
  }
  const Result result = std::move(solution.result);
  solution.system = {};
  solution.space.reset();
  solution.triangulation.reset();
  release_freed_memory();
  return run_on_smaller_meshes(scene, parameters, communicator, result, reason, keep);
}

} // namespace

Solution simulate(const Scene& scene, const Parameters& parameters, MPI_Comm communicator) {
  return run(scene, parameters, communicator, {}, Keep::nothing);
}

Solution simulate_next(const Scene& scene, const Parameters& parameters, Solution previous,
                       MPI_Comm communicator) {
  return run(scene, parameters, communicator, std::move(previous), Keep::everything);
}

} // namespace rollwave
