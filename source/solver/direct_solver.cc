#include "rollwave/solver/direct_solver.h"

#include "rollwave/base/memory.h"
#include "rollwave/scene/scene.h"
#include "rollwave/solver/cholmod_assembly.h"

#include <algorithm>
#include <utility>

namespace rollwave {

using namespace dealii;

void DirectSolver::number_unknowns(const Scene& scene) {
  const Work::Phase phase(*work, "ordering");
  unknown_of_dof = rollwave::number_unknowns(space, scene);
}

void DirectSolver::turn_to(const Scene& scene, const std::optional<FieldVector>& load, Work& work) {
  this->work = &work;
  if (angular_velocity != scene.angular_velocity)
    factorise(scene);
  places.clear();
  for (const SurfaceNode& node : space.contact_nodes())
    places.push_back(unknown_of_dof[node.dof] - (space.n_unknowns() - schur->size()));

  const Work::Phase phase(work, "contact");
  if (is_reduced && load.has_value() == this->load.has_value() &&
      (!load || std::equal(load->begin(), load->end(), this->load->begin())))
    return;
  this->load = load;
  const unsigned int m = schur->size();
  contact_load.reinit(m);
  reduced_load.clear();
  if (load) {
    reduced_load = cholesky->forward(gather(*load));
    ++work.forward_substitutions;
    contact_load = schur->multiply(Vector<double>(reduced_load.end() - m, reduced_load.end()));
  }
  is_reduced = true;
}

void DirectSolver::factorise(const Scene& scene) {
  const bool is_first = !cholesky; // later factors take the place of the one before
  if (is_first)
    number_unknowns(scene);
  const unsigned int m = space.candidate_nodes().size();
  angular_velocity.reset(); // until the factor is there
  is_reduced = false;
  schur.reset();
  {
    LowerTriplets triplets;
    {
      const Work::Phase phase(*work, "assembly");
      triplets = assemble_triplets(space, scene, unknown_of_dof);
      ++work->stiffness_assemblies;
    }
    const Work::Phase phase(*work, "ordering");
    if (is_first)
      cholesky = std::make_unique<CholmodFactor>(space.n_unknowns());
    if (cholesky->set_matrix(triplets))
      ++work->orderings;
  }
  const Work::Phase phase(*work, "factorisation");
  if (is_first)
    require_memory(sizeof(double) * (cholesky->n_factor_entries() + 1. * m * m), // L and L_cc
                   "the factor of the stiffness matrix with " + std::to_string(m) +
                       " contact nodes");
  cholesky->factorise();
  ++work->factorisations;
  schur = std::make_unique<DenseSchur>(cholesky->trailing_factor(m));
  angular_velocity = scene.angular_velocity;
}

Vector<double> DirectSolver::to_places(const Vector<double>& contact_values) const {
  Vector<double> values(schur->size());
  for (unsigned int i = 0; i < places.size(); ++i)
    values(places[i]) = contact_values(i);
  return values;
}

Vector<double> DirectSolver::from_places(const Vector<double>& values) const {
  Vector<double> contact_values(places.size());
  for (unsigned int i = 0; i < places.size(); ++i)
    contact_values(i) = values(places[i]);
  return contact_values;
}

Vector<double> DirectSolver::response(const Vector<double>& force, double /*accuracy*/) {
  return from_places(schur->solve(to_places(force)));
}

double DirectSolver::solve(const std::vector<bool>& pinned, ContactState& state,
                           double /*accuracy*/) {
  std::vector<bool> is_pinned(schur->size());
  for (unsigned int i = 0; i < places.size(); ++i)
    is_pinned[places[i]] = pinned[i];
  Vector<double> displacement = to_places(state.displacement), force = to_places(state.force);
  if (schur->solve(is_pinned, contact_load, displacement, force) > 0)
    ++work->dense_factorisations;
  state.displacement = from_places(displacement);
  state.force = from_places(force);
  return 0;
}

FieldVector DirectSolver::displacement_field(const ContactState& state) {
  const Work::Phase phase(*work, "back-substitution");
  std::vector<double> rhs = reduced_load;
  rhs.resize(space.n_unknowns());
  // The candidates that are no contact nodes are free.
  Vector<double> displacement = to_places(state.displacement), force(schur->size());
  std::vector<bool> is_pinned(schur->size());
  for (const unsigned int place : places)
    is_pinned[place] = true;
  schur->solve(is_pinned, contact_load, displacement, force);
  // With this right-hand side the last rows of L^T x = rhs return the displacement given.
  const Vector<double> trailing = schur->transposed_multiply(displacement);
  std::copy(trailing.begin(), trailing.end(), rhs.end() - trailing.size());
  ++work->back_substitutions;
  return scatter(cholesky->backward(std::move(rhs)));
}

FieldVector DirectSolver::apply(const FieldVector& field) const {
  const std::vector<double> product = cholesky->multiply(gather(field));
  FieldVector result = space.make_field();
  for (unsigned int dof = 0; dof < unknown_of_dof.size(); ++dof)
    if (unknown_of_dof[dof] >= 0)
      result(dof) = product[unknown_of_dof[dof]];
  return result;
}

std::vector<double> DirectSolver::gather(const FieldVector& field) const {
  std::vector<double> unknowns(space.n_unknowns());
  for (unsigned int dof = 0; dof < unknown_of_dof.size(); ++dof)
    if (unknown_of_dof[dof] >= 0)
      unknowns[unknown_of_dof[dof]] = field(dof);
  return unknowns;
}

FieldVector DirectSolver::scatter(const std::vector<double>& unknowns) const {
  FieldVector field = space.make_field();
  for (unsigned int dof = 0; dof < unknown_of_dof.size(); ++dof)
    if (unknown_of_dof[dof] >= 0)
      field(dof) = unknowns[unknown_of_dof[dof]];
  space.constraints().distribute(field);
  return field;
}

} // namespace rollwave
