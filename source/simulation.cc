#include "simulation.h"

#include "assembly.h"
#include "direct_solver.h"
#include "errors.h"
#include "refinement.h"
#include "residual_indicator.h"
#include "ring_mesh.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

MeshFigures describe_mesh(const RingSpace& space) {
  const auto& triangulation = space.dof_handler().get_triangulation();
  return {space.dof_handler().get_fe().degree,
          triangulation.n_active_cells(),
          space.n_unknowns(),
          static_cast<unsigned int>(space.contact_nodes().size()),
          GridTools::minimal_cell_diameter(triangulation, space.mapping()),
          GridTools::maximal_cell_diameter(triangulation, space.mapping())};
}

/// part / whole, where a part of nothing is nothing.
double relative(double part, double whole) {
  return part == 0 ? 0 : part / whole;
}

Residuals measure_residuals(const RingSpace& space, const ContactProblem& problem,
                            const ContactSolution& solution, const FieldVector& stiffness_times_u,
                            const std::optional<FieldVector>& load) {
  const auto& [displacement, force] = solution.state;
  FieldVector imbalance = stiffness_times_u;
  if (load)
    imbalance -= *load;
  for (unsigned int i = 0; i < problem.size(); ++i)
    imbalance(space.contact_nodes()[i].dof) += force(i);

  double penetration = 0, negative_pressure = 0, highest_pressure = 0;
  double force_times_gap = 0, force_times_road = 0;
  for (unsigned int i = 0; i < problem.size(); ++i) {
    const double gap = problem.road(i) - displacement(i);
    const double pressure = force(i) / problem.weight(i);
    penetration = std::max(penetration, -gap);
    negative_pressure = std::max(negative_pressure, -pressure);
    highest_pressure = std::max(highest_pressure, std::abs(pressure));
    force_times_gap += std::abs(force(i) * gap);
    force_times_road += std::abs(force(i) * problem.road(i));
  }
  return {relative(imbalance.l2_norm(), std::max(load ? load->l2_norm() : 0., force.l2_norm())),
          relative(penetration, displacement.linfty_norm()),
          relative(negative_pressure, highest_pressure),
          relative(force_times_gap, force_times_road)};
}

std::vector<ContactRow> tabulate_contact(const RingSpace& space, const ContactProblem& problem,
                                         const ContactState& state) {
  std::vector<ContactRow> rows;
  for (unsigned int i = 0; i < problem.size(); ++i)
    rows.push_back({space.contact_nodes()[i].angle, state.displacement(i), problem.road(i),
                    problem.road(i) - state.displacement(i), state.force(i) / problem.weight(i)});
  return rows;
}

/// The pressure of the mesh before at the nodes of another: linear between its nodes, zero outside
/// of the contact. Without entries when there was no mesh before.
Vector<double> carry_pressure(const Result& before, const std::vector<SurfaceNode>& nodes) {
  const auto& rows = before.contact_rows;
  if (rows.empty())
    return {};
  Vector<double> pressure(nodes.size());
  if (!before.patch.ends)
    return pressure;
  for (unsigned int i = 0; i < nodes.size(); ++i) {
    const double z = nodes[i].angle;
    if (z < before.patch.ends->first || z > before.patch.ends->second)
      continue;
    const auto right =
        std::lower_bound(rows.begin(), rows.end(), z,
                         [](const ContactRow& row, double at) { return row.angle < at; });
    if (right == rows.end())
      pressure(i) = rows.back().pressure;
    else if (right == rows.begin() || right->angle == z)
      pressure(i) = right->pressure;
    else {
      const auto left = right - 1;
      const double t = (z - left->angle) / (right->angle - left->angle);
      pressure(i) = (1 - t) * left->pressure + t * right->pressure;
    }
  }
  return pressure;
}

std::vector<SurfacePoint> tabulate_surface(const RingSpace& space, const FieldVector& field) {
  std::vector<SurfacePoint> points;
  for (const SurfaceNode& node : space.surface_nodes())
    points.push_back({node.angle, field(node.dof)});
  return points;
}

/// The discrete problem and its solution on one mesh.
struct MeshSolution {
  ContactProblem problem;
  ContactSolution contact;
};

/// Solves on the mesh of @p solution and fills in all but the certificate.
MeshSolution solve_on_mesh(const Scene& scene, const Parameters& parameters, Solution& solution) {
  Result& result = solution.result;
  Work& work = result.work;
  {
    const Work::Phase phase(work, "space");
    solution.space =
        std::make_unique<RingSpace>(*solution.triangulation, scene, parameters.mesh.degree);
  }
  const RingSpace& space = *solution.space;

  std::optional<FieldVector> load;
  if (scene.force) {
    const Work::Phase phase(work, "assembly");
    load = assemble_load(space, scene);
    ++work.load_assemblies;
  }

  DirectSolver solver(space, scene, load, work);
  const ContactProblem problem = make_contact_problem(space, scene);
  ContactSolution contact;
  {
    const Work::Phase phase(work, "contact");
    contact =
        solve_contact(solver, problem, parameters, carry_pressure(result, space.contact_nodes()));
  }
  solution.displacement = solver.displacement_field(contact.state);

  const Work::Phase phase(work, "measurement");
  const FieldVector stiffness_times_u = solver.apply(solution.displacement);
  const double norm_squared = solution.displacement * stiffness_times_u;
  result.mesh = describe_mesh(space);
  result.patch = measure_contact_patch(scene, space.contact_nodes(), problem, contact);
  result.energy = {norm_squared / 2 - (load ? solution.displacement * *load : 0.), norm_squared};
  result.residuals = measure_residuals(space, problem, contact, stiffness_times_u, load);
  result.contact_rows = tabulate_contact(space, problem, contact.state);
  result.surface = tabulate_surface(space, solution.displacement);
  result.history = contact.history;
  result.rho = contact.rho;
  result.remark = contact.remark;
  result.cycles.push_back({result.mesh.cells,
                           result.mesh.dofs,
                           static_cast<unsigned int>(result.history.size()),
                           0,
                           {}});
  return {problem, contact};
}

void certify_solution(const Scene& scene, const MeshSolution& on_mesh, Solution& solution) {
  solution.certificate = certify(*solution.space, scene, on_mesh.problem, on_mesh.contact,
                                 solution.displacement, solution.result.work);
  const Certificate& certificate = *solution.certificate;
  solution.result.certified = {certificate.energy_norm, certificate.relative,
                               certificate.lower_bound, certificate.upper_bound,
                               certificate.norm_squared};
  solution.result.cycles.back().certified = certificate.relative;
}

/// eta_K of each active cell.
std::vector<double> indicate(Indicator indicator, const Scene& scene, const MeshSolution& on_mesh,
                             Solution& solution) {
  if (indicator == Indicator::certificate)
    return solution.certificate->cell_bounds;
  const Work::Phase phase(solution.result.work, "indicator");
  return indicator == Indicator::kelly ? kelly_indicator(*solution.space, solution.displacement)
                                       : residual_indicator(*solution.space, scene, on_mesh.problem,
                                                            on_mesh.contact, solution.displacement);
}

/// Refines where @p indicators are large; what belongs to the old mesh is dropped. False, and
/// nothing is changed, when the mesh would get too large or no cell is marked.
bool refine(const std::vector<double>& indicators, const Parameters& parameters,
            Solution& solution) {
  const Work::Phase phase(solution.result.work, "mesh");
  const auto& mesh = parameters.mesh;
  std::unique_ptr<RingSpace> old_space = std::move(solution.space);
  if (!refine_mesh(*solution.triangulation, indicators, mesh.marking, mesh.marked_fraction,
                   mesh.degree, mesh.most_unknowns / (1. * mesh.degree * mesh.degree))) {
    solution.space = std::move(old_space);
    return false;
  }
  solution.certificate.reset();
  solution.result.certified.reset();
  return true;
}

std::string shortfall_text(const Parameters& parameters, double reached) {
  std::ostringstream text;
  text << "the certified relative error is " << reached << ", wanted "
       << parameters.mesh.wanted_relative_error
       << "; raise Mesh/Most unknowns or Mesh/Adaptive cycles, or want less";
  return text.str();
}

} // namespace

Solution simulate(const Scene& scene, const Parameters& parameters) {
  const auto& mesh = parameters.mesh;
  const bool certifies = parameters.certificate.error_bound;
  const bool wants_error = mesh.wanted_relative_error > 0;
  const unsigned int most_cycles =
      mesh.adaptive_cycles.value_or(wants_error ? std::numeric_limits<unsigned int>::max() : 0);
  Indicator indicator = mesh.indicator;
  if (indicator == Indicator::automatic)
    indicator = certifies ? Indicator::certificate : Indicator::residual;

  Solution solution;
  {
    const Work::Phase phase(solution.result.work, "mesh");
    solution.triangulation = make_ring_mesh(scene, parameters);
  }
  for (unsigned int cycle = 0;; ++cycle) {
    const MeshSolution on_mesh = solve_on_mesh(scene, parameters, solution);
    Result& result = solution.result;
    const bool is_last = cycle == most_cycles;
    if (certifies && (is_last || wants_error || indicator == Indicator::certificate))
      certify_solution(scene, on_mesh, solution);
    if (wants_error && result.certified->relative <= mesh.wanted_relative_error)
      break;
    if (!is_last) {
      const std::vector<double> indicators = indicate(indicator, scene, on_mesh, solution);
      if (refine(indicators, parameters, solution)) {
        double squared = 0;
        for (const double eta : indicators)
          squared += eta * eta;
        result.cycles.back().indicated = std::sqrt(squared);
        continue;
      }
      if (certifies && !result.certified)
        certify_solution(scene, on_mesh, solution);
    }
    if (wants_error)
      result.shortfall = shortfall_text(parameters, result.certified->relative);
    break;
  }
  return solution;
}

} // namespace rollwave
