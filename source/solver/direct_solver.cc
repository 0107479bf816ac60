#include "rollwave/solver/direct_solver.h"

#include "rollwave/scene/scene.h"

#include <algorithm>
#include <utility>

namespace rollwave {

using namespace dealii;

void DirectSolver::factorise(const Scene& scene) {
  angular_velocity.reset(); // until the factor is there
  is_reduced = false;
  schur.reset();
  {
    const Work::Phase phase(*work, "ordering");
    cholesky.number_unknowns(space.constraints());
  }
  {
    LowerTriplets triplets;
    {
      const Work::Phase phase(*work, "assembly");
      triplets = cholesky.assemble(space.constraints(), stiffness_products(space, scene));
      ++work->stiffness_assemblies;
    }
    const Work::Phase phase(*work, "ordering");
    cholesky.analyse(triplets, *work);
  }
  const Work::Phase phase(*work, "factorisation");
  cholesky.factorise(*work);
  schur = std::make_unique<DenseSchur>(
      cholesky.factor().trailing_factor(space.candidate_nodes().size()));
  angular_velocity = scene.angular_velocity;
}

void DirectSolver::turn_to(const Scene& scene, const std::optional<FieldVector>& load, Work& work) {
  this->work = &work;
  if (angular_velocity != scene.angular_velocity)
    factorise(scene);
  const auto& candidates = space.candidate_nodes();
  first_contact = std::find_if(candidates.begin(), candidates.end(),
                               [&](const SurfaceNode& node) {
                                 return node.dof == space.contact_nodes().front().dof;
                               }) -
                  candidates.begin();

  const Work::Phase phase(work, "contact");
  if (is_reduced && load.has_value() == this->load.has_value() &&
      (!load || std::equal(load->begin(), load->end(), this->load->begin())))
    return;
  this->load = load;
  const unsigned int m = schur->size();
  contact_load.reinit(m);
  reduced_load.clear();
  if (load) {
    reduced_load = cholesky.factor().forward(cholesky.gather(*load));
    ++work.forward_substitutions;
    contact_load = schur->multiply(Vector<double>(reduced_load.end() - m, reduced_load.end()));
  }
  is_reduced = true;
}

template <typename Values>
Values DirectSolver::on_candidates(const Values& contact_values) const {
  Values values(schur->size());
  std::copy(contact_values.begin(), contact_values.end(), values.begin() + first_contact);
  return values;
}

Vector<double> DirectSolver::on_contact(const Vector<double>& values) const {
  const auto first = values.begin() + first_contact;
  return Vector<double>(first, first + space.contact_nodes().size());
}

Vector<double> DirectSolver::response(const Vector<double>& force, double /*accuracy*/) {
  return on_contact(schur->solve(on_candidates(force)));
}

double DirectSolver::solve(const std::vector<bool>& pinned, ContactState& state,
                           double /*accuracy*/) {
  Vector<double> displacement = on_candidates(state.displacement),
                 force = on_candidates(state.force);
  work->dense_factorisations +=
      schur->solve(on_candidates(pinned), contact_load, displacement, force);
  state.displacement = on_contact(displacement);
  state.force = on_contact(force);
  return 0;
}

FieldVector DirectSolver::displacement_field(const ContactState& state) {
  const Work::Phase phase(*work, "back-substitution");
  std::vector<double> rhs = reduced_load;
  rhs.resize(space.n_unknowns());
  // The candidates that are no contact nodes are free.
  Vector<double> displacement = on_candidates(state.displacement), force(schur->size());
  schur->solve(on_candidates(std::vector<bool>(state.displacement.size(), true)), contact_load,
               displacement, force);
  // With this right-hand side the last rows of L^T x = rhs return the displacement given.
  const Vector<double> trailing = schur->transposed_multiply(displacement);
  std::copy(trailing.begin(), trailing.end(), rhs.end() - trailing.size());
  ++work->back_substitutions;
  FieldVector field = cholesky.scatter(cholesky.factor().backward(std::move(rhs)));
  space.constraints().distribute(field);
  return field;
}

FieldVector DirectSolver::apply(const FieldVector& field) const {
  return cholesky.scatter(cholesky.factor().multiply(cholesky.gather(field)));
}

} // namespace rollwave
