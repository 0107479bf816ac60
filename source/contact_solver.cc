#include "contact_solver.h"

#include "active_set.h"
#include "scene.h"
#include "uzawa.h"

namespace rollwave {

ContactProblem make_contact_problem(const RingSpace& space, const Scene& scene) {
  const auto& nodes = space.contact_nodes();
  ContactProblem problem;
  problem.road.reinit(nodes.size());
  problem.weight.reinit(nodes.size());
  problem.unit = scene.unit;
  problem.communicator = space.communicator();
  for (unsigned int i = 0; i < nodes.size(); ++i) {
    problem.road(i) = scene.road(nodes[i].angle);
    problem.weight(i) = nodes[i].weight;
  }
  return problem;
}

ContactSolution solve_contact(StiffnessSolver& solver, const ContactProblem& problem,
                              const Parameters& parameters, const dealii::Vector<double>& start) {
  const auto& contact = parameters.contact;
  if (contact.method == ContactMethod::uzawa)
    return uzawa(solver, problem,
                 {contact.rho, contact.stop, contact.tolerance, contact.most_steps}, start);
  return active_set(solver, problem, contact.most_steps, start);
}

} // namespace rollwave
