#include "rollwave/solver/iterative_solver.h"

#include "rollwave/mesh/assembly.h"
#include "rollwave/scene/scene.h"

#include <algorithm>

namespace rollwave {

using namespace dealii;

void IterativeSolver::set_problem(const Scene& scene, const ContactBoundary& boundary,
                                  const std::optional<FieldVector>& load,
                                  RunStatistics& statistics) {
  this->boundary = boundary;
  this->load = &load;
  this->statistics = &statistics;
  if (angular_velocity == scene.angular_velocity)
    return;
  const RunStatistics::Phase phase(statistics, "assembly");
  angular_velocity.reset();
  system.set_matrix(space.constraints(), stiffness_matrices(space, scene), statistics);
  ++statistics.stiffness_assemblies;
  angular_velocity = scene.angular_velocity;
}

Vector<double> IterativeSolver::reactions(const FieldVector* f, const FieldVector& u) const {
  FieldVector force = space.make_field();
  system.matrix().vmult(force, u);
  force *= -1;
  if (f)
    force += *f;
  return boundary.contact_values(force);
}

double IterativeSolver::solve(const std::vector<bool>& pinned, ContactState& state,
                              double accuracy) {
  return solve(pinned, *load ? &**load : nullptr, field, state, accuracy);
}

double IterativeSolver::solve(const std::vector<bool>& pinned, const FieldVector* f, FieldVector& u,
                              ContactState& state, double accuracy) {
  const auto& nodes = boundary.contact_nodes();
  AssertDimension(pinned.size(), nodes.size());
  IndexSet pinned_dofs(space.dof_handler().n_dofs());
  FieldVector rhs = f ? *f : space.make_field();
  for (unsigned int i = 0; i < nodes.size(); ++i) {
    const auto dof = nodes[i].dof;
    if (pinned[i])
      pinned_dofs.add_index(dof);
    if (rhs.in_local_range(dof)) {
      if (pinned[i])
        u(dof) = state.displacement(i);
      else
        rhs(dof) -= state.force(i);
    }
  }
  system.pin(pinned_dofs);

  const double load_norm = f ? f->l2_norm() : 0.;
  const auto scale = [&](const FieldVector& approximation) {
    Vector<double> force = reactions(f, approximation);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (!pinned[i])
        force(i) = state.force(i);
    return std::max<double>(load_norm, force.l2_norm());
  };
  const double residual = system.improve(u, rhs, scale, accuracy, *statistics);

  const Vector<double> force = reactions(f, u), displacement = boundary.contact_values(u);
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (pinned[i])
      state.force(i) = force(i);
    else
      state.displacement(i) = displacement(i);
  return residual;
}

Vector<double> IterativeSolver::apply_compliance(const Vector<double>& force, double accuracy) {
  const auto& nodes = boundary.contact_nodes();
  system.pin(IndexSet(space.dof_handler().n_dofs()));
  FieldVector rhs = space.make_field(), u = space.make_field();
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (rhs.in_local_range(nodes[i].dof))
      rhs(nodes[i].dof) = force(i);
  system.improve(
      u, rhs, [&](const FieldVector&) { return force.l2_norm(); }, accuracy, *statistics);
  return boundary.contact_values(u);
}

ContactState IterativeSolver::derivative(const std::vector<bool>& pinned,
                                         const Vector<double>& displacement, double accuracy) {
  FieldVector u = space.make_field();
  ContactState change = {displacement, Vector<double>(displacement.size())};
  solve(pinned, nullptr, u, change, accuracy);
  return change;
}

FieldVector IterativeSolver::displacement_field(const ContactState& state) {
  if (boundary.contact_values(field) !=
      state.displacement) { // it is not the state of the last solve
    ContactState same = state;
    solve(std::vector<bool>(state.displacement.size(), true), same, final_accuracy);
  }
  FieldVector u = field;
  space.constraints().distribute(u);
  u.update_ghost_values();
  return u;
}

FieldVector IterativeSolver::apply(const FieldVector& u) const {
  FieldVector product = space.make_field();
  system.matrix().vmult(product, u);
  space.constraints().set_zero(product);
  return product;
}

} // namespace rollwave
