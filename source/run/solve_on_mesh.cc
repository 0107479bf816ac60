#include "rollwave/run/solve_on_mesh.h"

#include "rollwave/base/errors.h"
#include "rollwave/contact/contact_patch.h"
#include "rollwave/contact/load_control.h"
#include "rollwave/run/round_off.h"
#include "rollwave/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// part / whole; 0 if part is 0.
double relative(double part, double whole) {
  return part == 0 ? 0 : part / whole;
}

/// @param round_off of K u, as equilibrium_round_off()
Residuals measure_residuals(const ContactBoundary& boundary, const ContactProblem& problem,
                            const ContactSolution& solution, FieldVector stiffness_times_u,
                            double round_off, const std::optional<FieldVector>& load) {
  const auto& [displacement, force] = solution.state;
  FieldVector imbalance = std::move(stiffness_times_u);
  if (load)
    imbalance -= *load;
  for (unsigned int i = 0; i < problem.size(); ++i)
    if (const auto dof = boundary.contact_nodes()[i].dof; imbalance.in_local_range(dof))
      imbalance(dof) += force(i);

  const Vector<double> gap = problem.gaps(displacement), pressure = problem.pressures(force);
  double penetration = 0, negative_pressure = 0, force_times_gap = 0, force_times_road = 0;
  for (unsigned int i = 0; i < problem.size(); ++i) {
    penetration = std::max(penetration, -gap(i));
    negative_pressure = std::max(negative_pressure, -pressure(i));
    force_times_gap += std::abs(force(i) * gap(i));
    force_times_road += std::abs(force(i) * problem.phi(i));
  }
  const double forces = std::max(load ? load->l2_norm() : 0., force.l2_norm());
  return {relative(imbalance.l2_norm(), forces), relative(penetration, displacement.linfty_norm()),
          relative(negative_pressure, pressure.linfty_norm()),
          relative(force_times_gap, force_times_road),
          std::max(wanted_residual, relative(round_off, forces))};
}

/// @throws NotSolved if @p squared is not finite
void require_finite(double squared, const std::string& what) {
  if (!std::isfinite(squared))
    throw NotSolved(what +
                    " overflows double precision: change Cylinder/Radial force, or choose radii "
                    "that differ more");
}

/// Makes the force and the load of @p cache those of the scene.
void make_load(const Scene& scene, const RingSpace& space, MeshCache& cache,
               RunStatistics& statistics) {
  if (!scene.force) {
    cache.force.reset();
    cache.load.reset();
  } else if (!cache.load || cache.force_text != scene.force.text) {
    const RunStatistics::Phase phase(statistics, "assembly");
    RadialShapesOfMesh shapes(scene, space.dof_handler().get_fe().degree);
    cache.force = std::make_unique<ForceIntegral>(space, scene, shapes);
    cache.load = assemble_load(space, *cache.force, shapes);
    cache.force_text = scene.force.text;
    ++statistics.load_assemblies;
  }
  if (cache.load)
    require_finite(cache.load->norm_sqr(), "the load");
}

/// Finds the distance if a load is given. Then solves the contact problem.
void solve_contact_on(const RunOptions& options, const PressureProfile& start,
                      ContactLinearSolver& solver, const ContactObserver& step_ended,
                      MeshSolution& solution) {
  const ContactBoundary& boundary = solution.boundary;
  Vector<double> pressure = start.at(boundary.contact_nodes());
  if (solution.scene.load) {
    RoadPosition road =
        find_distance(solver, boundary, solution.scene, options.contact.most_steps, pressure);
    solution.scene = with_distance(solution.scene, road.distance);
    if (const auto shortfall = missing_load_text(solution.scene, road.load))
      solution.shortfalls.push_back(*shortfall);
    pressure = std::move(road.pressure);
    solution.distance_history = std::move(road.history);
  }
  solution.problem = make_contact_problem(boundary, solution.scene);
  solution.contact = solve_contact(solver, solution.problem, options.contact, pressure, step_ended);
  if (!solution.contact.remark.empty())
    solution.remarks.push_back(solution.contact.remark);
}

/// Sets the work-conjugate load and the stiffness to NaN, since nodes next to the tangent of a drum
/// do not resolve them.
void leave_out_unresolved_loads(MeshSolution& solution) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  solution.resultants.loads.work_conjugate = unknown;
  solution.resultants.stiffness = {unknown, unknown, unknown};
  solution.remarks.push_back("contact reaches the tangent of the drum on this mesh, where the "
                             "work-conjugate load and the stiffness are not resolved: they are "
                             "left out");
  if (const auto& load = solution.scene.load; load && load->kind == LoadKind::work_conjugate)
    solution.shortfalls = {"the work-conjugate load that was given is not resolved, since contact "
                           "reaches the tangent of the drum; raise Mesh/Angular cells, or set "
                           "Road/Load kind = vertical"};
}

} // namespace

PressureProfile::PressureProfile(const std::vector<SurfaceNode>& nodes,
                                 const Vector<double>& pressure,
                                 const std::optional<std::pair<double, double>>& ends)
    : ends(ends) {
  for (unsigned int i = 0; i < nodes.size(); ++i)
    pressures[nodes[i].angle] = pressure(i);
}

Vector<double> PressureProfile::at(const std::vector<SurfaceNode>& nodes) const {
  if (pressures.empty())
    return {};
  Vector<double> values(nodes.size());
  for (unsigned int i = 0; i < nodes.size(); ++i)
    values(i) = at(nodes[i].angle);
  return values;
}

double PressureProfile::at(double angle) const {
  if (!ends || angle < ends->first || angle > ends->second)
    return 0;
  const auto next = pressures.lower_bound(angle);
  if (next == pressures.end() || (next == pressures.begin() && next->first > angle))
    return 0;
  if (next->first == angle)
    return next->second;
  const auto before = std::prev(next);
  const double t = (angle - before->first) / (next->first - before->first);
  return (1 - t) * before->second + t * next->second;
}

PressureProfile pressure_profile(const MeshSolution& solution) {
  return {solution.boundary.contact_nodes(),
          solution.problem.pressures(solution.contact.state.force), solution.resultants.ends};
}

MeshSolution solve_on_mesh(const Scene& scene, const RunOptions& options,
                           const ContactBoundary& candidates, const PressureProfile& start,
                           MeshCache& cache, RunStatistics& statistics,
                           const ContactObserver& step_ended) {
  const RingSpace& space = candidates.space();
  MeshSolution solution = {scene, ContactBoundary(space, scene.zone())};
  const ContactBoundary& boundary = solution.boundary;
  make_load(scene, space, cache, statistics);
  if (cache.stiffness.solver)
    cache.stiffness.solver->set_problem(scene, boundary, cache.load, statistics);
  else
    cache.stiffness =
        choose_solver(options.solver.kind, candidates, scene, boundary, cache.load, statistics);
  ContactLinearSolver& solver = *cache.stiffness.solver;
  if (!cache.stiffness.remark.empty())
    solution.remarks.push_back(cache.stiffness.remark);
  Loads stiffness;
  {
    const RunStatistics::Phase phase(statistics, "contact");
    solve_contact_on(options, start, solver, step_ended, solution);
    solution.displacement = solver.displacement_field(solution.contact.state);
    stiffness = contact_stiffness(solver, boundary, solution.scene, solution.problem,
                                  solution.contact, options.contact.most_steps);
  }
  const RunStatistics::Phase phase(statistics, "measurement");
  solution.resultants =
      measure_contact(solution.scene, boundary.contact_nodes(), solution.problem, solution.contact);
  solution.resultants.stiffness = stiffness;
  if (reaches_tangent(solution.problem, solution.contact.active))
    leave_out_unresolved_loads(solution);
  FieldVector stiffness_times_u = solver.apply(solution.displacement);
  const double norm_squared = solution.displacement * stiffness_times_u;
  const double work_of_force = cache.load ? solution.displacement * *cache.load : 0.;
  require_finite(norm_squared + std::abs(work_of_force), "the energy");
  solution.energy = {norm_squared / 2 - work_of_force, norm_squared};
  solution.residuals = measure_residuals(
      boundary, solution.problem, solution.contact, std::move(stiffness_times_u),
      equilibrium_round_off(space, solution.scene, solution.displacement), cache.load);
  return solution;
}

Certificate certify(const MeshSolution& solution, MeshCache& cache, RunStatistics& statistics) {
  StressFunction& stress_function =
      cache.stress_function_for(solution.scene, solution.boundary.space(), statistics);
  return certify(solution.boundary, solution.scene, solution.problem, solution.contact,
                 solution.displacement, cache.force.get(), stress_function, statistics);
}

} // namespace rollwave
