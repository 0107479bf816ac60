#include "rollwave/contact/contact_problem.h"

#include "rollwave/contact/active_set.h"
#include "rollwave/contact/uzawa.h"
#include "rollwave/scene/units.h"

#include <cmath>

namespace rollwave {

dealii::Vector<double> ContactProblem::gaps(const dealii::Vector<double>& displacement) const {
  dealii::Vector<double> gap = phi;
  gap -= displacement;
  return gap;
}

dealii::Vector<double> ContactProblem::pressures(const dealii::Vector<double>& force) const {
  dealii::Vector<double> pressure = force;
  for (unsigned int i = 0; i < size(); ++i)
    pressure(i) /= weight(i);
  return pressure;
}

dealii::Vector<double> ContactProblem::forces(const dealii::Vector<double>& pressure) const {
  dealii::Vector<double> force = pressure;
  force.scale(weight);
  return force;
}

ContactProblem make_contact_problem(const ContactBoundary& boundary, const Scene& scene) {
  const auto& nodes = boundary.contact_nodes();
  ContactProblem problem;
  problem.phi.reinit(nodes.size());
  problem.weight.reinit(nodes.size());
  problem.road = scene.road;
  problem.unit = 1 / scene.units.of(Quantity::force_density);
  for (unsigned int i = 0; i < nodes.size(); ++i) {
    problem.phi(i) = scene.phi(nodes[i].angle);
    problem.weight(i) = nodes[i].weight;
    problem.x.push_back(from_lowest_point(nodes[i].angle));
    problem.cell_ratio.push_back(nodes[i].cell_ratio);
  }
  return problem;
}

Loads loads_of(const ContactProblem& problem, const dealii::Vector<double>& force) {
  Loads loads = {};
  double work_conjugate = 0;
  for (unsigned int i = 0; i < problem.size(); ++i) {
    if (force(i) == 0)
      continue;
    loads.total += force(i);
    loads.vertical += force(i) * std::cos(problem.x[i]);
    work_conjugate += force(i) * problem.road.distance_derivative(problem.x[i]);
  }
  loads.work_conjugate = work_conjugate;
  return loads;
}

ContactSolution solve_contact(const ContactEquations& equations, const ContactProblem& problem,
                              const ContactOptions& options, const dealii::Vector<double>& start,
                              RunStatistics& statistics, const ContactObserver& step_ended) {
  if (options.method == ContactMethod::uzawa)
    return uzawa(equations, problem, options, start, statistics, step_ended);
  return active_set(equations, problem, options.most_steps, start, statistics, step_ended);
}

} // namespace rollwave
