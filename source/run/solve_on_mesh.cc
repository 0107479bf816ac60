#include "rollwave/run/solve_on_mesh.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/interrupt.h"
#include "rollwave/contact/contact_patch.h"
#include "rollwave/contact/load_control.h"
#include "rollwave/run/round_off.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// part / whole; 0 if part is 0.
double relative(double part, double whole) {
  return part == 0 ? 0 : part / whole;
}

Residuals measure_residuals(const MeshSolution& solution, FieldVector stiffness_times_u,
                            const FieldVector* load) {
  const ContactBoundary& boundary = solution.boundary;
  const ContactProblem& problem = solution.problem;
  const Vector<double>& displacement = solution.contact.state.displacement;
  const Vector<double>& force = solution.contact.state.force;
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
  const double forces = std::max(load ? load->l2_norm() : 0., force.l2_norm()),
               round_off =
                   equilibrium_round_off(boundary.space(), solution.scene, solution.displacement);
  return {relative(imbalance.l2_norm(), forces), relative(penetration, displacement.linfty_norm()),
          relative(negative_pressure, pressure.linfty_norm()),
          relative(force_times_gap, force_times_road),
          std::max(wanted_residual, relative(round_off, forces))};
}

/// Finds the distance if a load or a nip is given. Then solves the contact problem.
void solve_contact_on(const ContactOptions& options, const PressureProfile& start,
                      const ContactEquations& equations, const ContactObserver& step_ended,
                      RunStatistics& statistics, MeshSolution& solution) {
  const ContactBoundary& boundary = solution.boundary;
  Vector<double> pressure = start.at(boundary.contact_nodes());
  if (!solution.scene.has_distance()) {
    RoadPosition road = find_distance(equations, boundary, solution.scene, options.most_steps,
                                      pressure, statistics);
    solution.scene = with_distance(solution.scene, road.distance);
    solution.road_refusal = std::move(road.refusal);
    solution.result.notes = std::move(road.notes);
    pressure = std::move(road.pressure);
    solution.result.distance_history = std::move(road.history);
  }
  solution.problem = make_contact_problem(boundary, solution.scene);
  const auto observe = [&](const std::vector<ContactStep>& history) {
    if (step_ended)
      step_ended(history);
    // Its steps may be very many.
    if (options.method == ContactMethod::uzawa && is_interrupted(boundary.space().communicator()))
      throw Interrupted("interrupted in step " + std::to_string(history.size()) +
                        " of Uzawa's method");
  };
  solution.contact =
      solve_contact(equations, solution.problem, options, pressure, statistics, observe);
  MeshResult& result = solution.result;
  result.history = std::move(solution.contact.history);
  result.step_length = solution.contact.step_length;
  result.notes.insert(result.notes.end(), solution.contact.notes.begin(),
                      solution.contact.notes.end());
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
          solution.problem.pressures(solution.contact.state.force), solution.result.contact.ends};
}

ContactEquations contact_equations(const System& system, const Load* load,
                                   const ContactBoundary& boundary) {
  const auto first = system.boundary.contact_number(boundary.first_surface_node());
  AssertThrow(first && *first + boundary.size() <= system.boundary.size(), ExcInternalError());
  return {*system.condensed, load ? load->condensed : Vector<double>(), *first, boundary.size()};
}

MeshSolution solve_on_mesh(const MeshObjects& objects, const Scene& scene,
                           const ContactOptions& options, const PressureProfile& start,
                           RunStatistics& statistics, const ContactObserver& step_ended) {
  const System& system = objects.system;
  const Load* const load = objects.load.get();
  MeshSolution solution = {{scene, ContactBoundary(system.boundary.space(), scene.zone())}};
  const ContactEquations equations = contact_equations(system, load, solution.boundary);
  const FieldVector* const f = load ? &load->vector : nullptr;
  {
    const RunStatistics::Phase phase(statistics, "contact");
    solve_contact_on(options, start, equations, step_ended, statistics, solution);
  }
  {
    const RunStatistics::Phase phase(statistics, "back-substitution");
    solution.displacement = expand(system, load, solution.contact.state.kept, statistics);
  }
  const RunStatistics::Phase phase(statistics, "measurement");
  MeshResult& result = solution.result;
  result.contact = measure_contact(solution.scene, solution.problem, solution.contact,
                                   solution.boundary.space().dof_handler().get_fe().degree);
  const bool has_nip = scene.nip && !solution.road_refusal && shortfall_text(result.notes).empty();
  if (const auto& given = scene.load;
      has_nip && given && result.contact.loads.of(given->kind) > 0) {
    result.modulus_ratio = given->value / result.contact.loads.of(given->kind);
    solution.scene = calibrated(solution.scene, *result.modulus_ratio);
  }
  if (reaches_tangent(solution.boundary, solution.scene.road, solution.contact.active)) {
    result.contact.loads.work_conjugate.reset();
    result.notes.push_back({Note::Kind::remark,
                            "contact reaches the tangent of the drum on this mesh, where the "
                            "work-conjugate load and the stiffness are not resolved: they are "
                            "left out"});
  }
  FieldVector stiffness_times_u = system.factor->apply(solution.displacement);
  const double norm_squared = solution.displacement * stiffness_times_u;
  const double work_of_force = f ? solution.displacement * *f : 0.;
  require_finite(norm_squared + std::abs(work_of_force), "the energy");
  result.energy = {norm_squared / 2 - work_of_force, norm_squared};
  result.residuals = measure_residuals(solution, std::move(stiffness_times_u), f);
  return solution;
}

} // namespace rollwave
