#include "rollwave/solver/iterative_solver.h"

#include "rollwave/mesh/assembly.h"
#include "rollwave/scene/scene.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

IterativeSolver::IterativeSolver(const RingSpace& space)
    : space(space), system(space), contact_dofs(space.dof_handler().n_dofs()),
      pinned_dofs(contact_dofs), multigrid_dofs(contact_dofs), field(space.make_field()) {
  for (const SurfaceNode& node : space.candidate_nodes())
    contact_dofs.add_index(node.dof);
  contact_dofs.compress();
}

void IterativeSolver::turn_to(const Scene& scene, const std::optional<FieldVector>& load,
                              Work& work) {
  this->load = &load;
  this->work = &work;
  if (angular_velocity == scene.angular_velocity)
    return;
  const Work::Phase phase(work, "assembly");
  angular_velocity.reset();
  system.set_matrix(scene, space.constraints(), stiffness_products(space, scene), work);
  pinned_dofs.clear();
  multigrid_dofs.clear();
  find_couplings();
  ++work.stiffness_assemblies;
  angular_velocity = scene.angular_velocity;
}

void IterativeSolver::find_couplings() {
  const IndexSet& owned = space.dof_handler().locally_owned_dofs();
  // A matrix is symmetric: the rows that contact nodes couple to are the columns of theirs, of
  // which each process knows some.
  std::vector<types::global_dof_index> coupled;
  for (const auto dof : contact_dofs)
    if (owned.is_element(dof))
      system.visit_row(dof, [&](auto column, double) { coupled.push_back(column); });
  IndexSet rows(contact_dofs.size());
  for (const auto& part : Utilities::MPI::all_gather(space.communicator(), coupled))
    rows.add_indices(part.begin(), part.end());
  rows.compress();

  couplings.clear();
  DynamicSparsityPattern pattern(contact_dofs.size(), contact_dofs.size(), owned);
  for (const auto row : rows& owned)
    system.visit_row(row, [&, row = row](auto column, double value) {
      if (contact_dofs.is_element(row) || contact_dofs.is_element(column)) {
        couplings.push_back({row, column, value});
        pattern.add(row, column);
      }
    });
  contact_matrix.reinit(owned, owned, pattern, space.communicator());
  for (const auto& [row, column, value] : couplings)
    contact_matrix.set(row, column, value);
  contact_matrix.compress(VectorOperation::insert);
}

void IterativeSolver::pin(const std::vector<bool>& pinned) {
  IndexSet dofs(contact_dofs.size());
  for (unsigned int i = 0; i < pinned.size(); ++i)
    if (pinned[i])
      dofs.add_index(space.contact_nodes()[i].dof);
  dofs.compress();
  if (dofs == pinned_dofs)
    return;
  pinned_dofs = dofs;
  // Each node by which the preconditioner is behind costs one or two iterations, a new
  // preconditioner about twenty.
  constexpr unsigned int most_behind = 2;
  const auto n_behind =
      dofs.n_elements() + multigrid_dofs.n_elements() - 2 * (dofs & multigrid_dofs).n_elements();
  if (n_behind > most_behind) {
    system.drop_preconditioner();
    multigrid_dofs = dofs;
  }
  auto& matrix = system.change_matrix();
  for (const auto& [row, column, value] : couplings)
    matrix.set(row, column, row == column || !(is_pinned(row) || is_pinned(column)) ? value : 0.);
  matrix.compress(VectorOperation::insert);
}

Vector<double> IterativeSolver::reactions(const FieldVector& u) const {
  FieldVector force = space.make_field();
  contact_matrix.vmult(force, u);
  force *= -1;
  if (*load)
    force += **load;
  return space.contact_values(force);
}

double IterativeSolver::solve(const std::vector<bool>& pinned, ContactState& state,
                              double accuracy) {
  const auto& nodes = space.contact_nodes();
  AssertDimension(pinned.size(), nodes.size());
  pin(pinned);

  // The pinned nodes at their places, and what that does to the others.
  FieldVector at_pinned = space.make_field(), rhs = space.make_field();
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (pinned[i] && field.in_local_range(nodes[i].dof))
      at_pinned(nodes[i].dof) = field(nodes[i].dof) = state.displacement(i);
  contact_matrix.vmult(rhs, at_pinned);
  rhs *= -1;
  if (*load)
    rhs += **load;
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (const auto dof = nodes[i].dof; rhs.in_local_range(dof)) {
      if (pinned[i])
        rhs(dof) = system.matrix().diag_element(dof) * state.displacement(i);
      else
        rhs(dof) -= state.force(i);
    }

  const double load_norm = *load ? (*load)->l2_norm() : 0.;
  const auto scale = [&](const FieldVector& u) {
    const Vector<double> force = reactions(u);
    double squared = 0;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      squared += std::pow(pinned[i] ? force(i) : state.force(i), 2);
    return std::max(load_norm, std::sqrt(squared));
  };
  const double residual = system.improve(field, rhs, scale, accuracy, *work);

  const Vector<double> force = reactions(field), displacement = space.contact_values(field);
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (pinned[i])
      state.force(i) = force(i);
    else
      state.displacement(i) = displacement(i);
  return residual;
}

Vector<double> IterativeSolver::response(const Vector<double>& force, double accuracy) {
  const auto& nodes = space.contact_nodes();
  pin(std::vector<bool>(nodes.size(), false));
  FieldVector rhs = space.make_field(), u = space.make_field();
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (rhs.in_local_range(nodes[i].dof))
      rhs(nodes[i].dof) = force(i);
  system.improve(
      u, rhs, [&](const FieldVector&) { return force.l2_norm(); }, accuracy, *work);
  return space.contact_values(u);
}

FieldVector IterativeSolver::displacement_field(const ContactState& /*state*/) {
  FieldVector u = field;
  space.constraints().distribute(u);
  u.update_ghost_values();
  return u;
}

FieldVector IterativeSolver::apply(const FieldVector& u) const {
  // What the matrix lacks are the couplings of pinned nodes.
  FieldVector product = space.make_field(), at_contact = space.make_field(),
              at_pinned = space.make_field(), of_pinned = space.make_field();
  system.matrix().vmult(product, u);
  contact_matrix.vmult(at_contact, u);
  for (const auto dof : pinned_dofs)
    if (u.in_local_range(dof))
      at_pinned(dof) = u(dof);
  contact_matrix.vmult(of_pinned, at_pinned);
  product += of_pinned;
  for (const auto dof : pinned_dofs)
    if (u.in_local_range(dof))
      product(dof) = at_contact(dof);
  space.constraints().set_zero(product);
  return product;
}

} // namespace rollwave
