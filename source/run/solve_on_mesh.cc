#include "rollwave/run/solve_on_mesh.h"

#include "rollwave/base/errors.h"
#include "rollwave/contact/load_control.h"
#include "rollwave/scene/scene.h"

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

MeshFigures describe_mesh(const RingSpace& space) {
  const auto& handler = space.dof_handler();
  const auto [least_diameter, largest_diameter] = space.diameters();
  return {handler.get_fe().degree,
          static_cast<unsigned int>(handler.get_triangulation().n_global_active_cells()),
          space.n_unknowns(),
          static_cast<unsigned int>(space.contact_nodes().size()),
          least_diameter,
          largest_diameter};
}

/// part / whole, where a part of nothing is nothing.
double relative(double part, double whole) {
  return part == 0 ? 0 : part / whole;
}

Residuals measure_residuals(const RingSpace& space, const ContactProblem& problem,
                            const ContactSolution& solution, FieldVector stiffness_times_u,
                            const std::optional<FieldVector>& load) {
  const auto& [displacement, force] = solution.state;
  FieldVector imbalance = std::move(stiffness_times_u);
  if (load)
    imbalance -= *load;
  for (unsigned int i = 0; i < problem.size(); ++i)
    if (const auto dof = space.contact_nodes()[i].dof; imbalance.in_local_range(dof))
      imbalance(dof) += force(i);

  const Vector<double> gap = problem.gaps(displacement), pressure = problem.pressures(force);
  double penetration = 0, negative_pressure = 0, force_times_gap = 0, force_times_road = 0;
  for (unsigned int i = 0; i < problem.size(); ++i) {
    penetration = std::max(penetration, -gap(i));
    negative_pressure = std::max(negative_pressure, -pressure(i));
    force_times_gap += std::abs(force(i) * gap(i));
    force_times_road += std::abs(force(i) * problem.road(i));
  }
  const double forces = std::max(load ? load->l2_norm() : 0., force.l2_norm());
  return {relative(imbalance.l2_norm(), forces), relative(penetration, displacement.linfty_norm()),
          relative(negative_pressure, pressure.linfty_norm()),
          relative(force_times_gap, force_times_road)};
}

std::vector<ContactRow> tabulate_contact(const RingSpace& space, const ContactProblem& problem,
                                         const ContactState& state) {
  const Vector<double> gap = problem.gaps(state.displacement),
                       pressure = problem.pressures(state.force);
  std::vector<ContactRow> rows;
  for (unsigned int i = 0; i < problem.size(); ++i)
    rows.push_back({space.contact_nodes()[i].angle, state.displacement(i), problem.road(i), gap(i),
                    pressure(i), problem.weight(i)});
  return rows;
}

std::vector<SurfacePoint> tabulate_surface(const RingSpace& space, const FieldVector& field) {
  const std::vector<double> values = space.surface_values(field);
  std::vector<SurfacePoint> points;
  for (unsigned int i = 0; i < values.size(); ++i)
    points.push_back({space.surface_nodes()[i].angle, values[i]});
  return points;
}

/// @throws NotSolved where squares of such numbers overflow or there is none
void require_finite(double squared, const std::string& what) {
  if (!std::isfinite(squared))
    throw NotSolved(what + " is beyond what numbers can hold: change Cylinder/Radial force or the "
                           "radii, which must not be too close to each other either");
}

/// Makes the force and the load of @p system those of the scene.
void make_load(const Scene& scene, const RingSpace& space, MeshCache& system, Work& work) {
  if (!scene.force) {
    system.force.reset();
    system.load.reset();
  } else if (!system.load || system.force_text != scene.force_text) {
    const Work::Phase phase(work, "assembly");
    RadialShapesOfMesh shapes(scene, space.dof_handler().get_fe().degree);
    system.force = std::make_unique<ForceIntegral>(space, scene, shapes);
    system.load = assemble_load(space, *system.force, shapes);
    system.force_text = scene.force_text;
    ++work.load_assemblies;
  }
  if (system.load)
    require_finite(system.load->norm_sqr(), "the load");
}

} // namespace

StressFunction& MeshCache::dual_of(const Scene& scene, const RingSpace& space, Work& work) {
  const Work::Phase phase(work, "certificate");
  if (!dual || dual->angular_velocity() != scene.angular_velocity) {
    dual.reset(); // its memory is free before the next one needs it
    dual = std::make_unique<StressFunction>(space, scene, stiffness.kind, work);
  }
  return *dual;
}

MeshSolution solve_on_mesh(const Scene& scene, const RunOptions& options, const RingSpace& space,
                           const Vector<double>& start, MeshCache& system, Work& work) {
  MeshSolution solution;
  solution.scene = scene;
  make_load(scene, space, system, work);
  auto& solver = system.stiffness.solver;
  const std::string& remark = system.stiffness.remark;
  if (solver)
    solver->set_problem(scene, system.load, work);
  else
    system.stiffness = choose_solver(options.solver.kind, space, scene, system.load, work);
  {
    const Work::Phase phase(work, "contact");
    Vector<double> pressure = start;
    if (scene.load) {
      RoadPosition road = find_distance(*solver, space, scene, options.contact.most_steps, start);
      solution.scene = with_distance(scene, road.distance);
      solution.shortfall = missing_load_text(scene, road.load);
      pressure = std::move(road.pressure);
    }
    solution.problem = make_contact_problem(space, solution.scene);
    solution.contact = solve_contact(*solver, solution.problem, options.contact, pressure);
  }
  if (!remark.empty())
    solution.contact.remark =
        remark + (solution.contact.remark.empty() ? "" : "; ") + solution.contact.remark;
  solution.displacement = solver->displacement_field(solution.contact.state);
  {
    const Work::Phase phase(work, "contact");
    solution.stiffness = contact_stiffness(*solver, space, solution.scene, solution.problem,
                                           solution.contact, options.contact.most_steps);
  }
  const Work::Phase phase(work, "measurement");
  FieldVector stiffness_times_u = solver->apply(solution.displacement);
  const double norm_squared = solution.displacement * stiffness_times_u;
  const double work_of_force = system.load ? solution.displacement * *system.load : 0.;
  solution.energy = {norm_squared / 2 - work_of_force, norm_squared};
  require_finite(norm_squared + std::abs(work_of_force), "the energy");
  solution.residuals = measure_residuals(space, solution.problem, solution.contact,
                                         std::move(stiffness_times_u), system.load);
  return solution;
}

void measure(const RingSpace& space, const MeshSolution& solution, Result& result) {
  const Work::Phase phase(result.work, "measurement");
  const auto& [scene, problem, contact, stiffness, shortfall, displacement, energy, residuals] =
      solution;
  result.mesh = describe_mesh(space);
  result.road_distance = scene.road_distance;
  result.patch = measure_contact(scene, space.contact_nodes(), problem, contact);
  result.patch.stiffness = stiffness;
  result.energy = energy;
  result.residuals = residuals;
  result.contact_rows = tabulate_contact(space, problem, contact.state);
  result.surface = tabulate_surface(space, displacement);
  result.history = contact.history;
  result.rho = contact.rho;
  result.remarks.clear();
  result.shortfalls.clear();
  if (reaches_tangent(problem, contact.active)) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    result.patch.work_conjugate_load = unknown;
    result.patch.stiffness = {unknown, unknown, unknown};
    result.remarks.push_back("contact reaches the tangent of the drum on this mesh, where the "
                             "work-conjugate load and the stiffness are not resolved: they are "
                             "left out");
    if (scene.load && scene.load->kind == LoadKind::work_conjugate)
      result.shortfalls.push_back("the work-conjugate load that was given is not resolved, since "
                                  "contact reaches the tangent of the drum; raise Mesh/Angular "
                                  "cells, or set Road/Load kind = vertical");
  }
  if (!contact.remark.empty())
    result.remarks.push_back(contact.remark);
  if (shortfall)
    result.shortfalls.push_back(*shortfall);
  result.cycles.push_back({result.mesh.cells,
                           result.mesh.dofs,
                           static_cast<unsigned int>(result.history.size()),
                           0,
                           {}});
}

} // namespace rollwave
