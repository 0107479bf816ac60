#include "rollwave/solver/direct_solver.h"

#include "rollwave/scene/scene.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace rollwave {

using namespace dealii;

void DirectSolver::number_unknowns(const Scene& scene) {
  const Work::Phase phase(*work, "ordering");
  const auto& nodes = space.candidate_nodes();
  std::vector<double> heights;
  for (const SurfaceNode& node : nodes)
    heights.push_back(scene.road(node.angle));
  std::vector<unsigned int> by_place(nodes.size());
  std::iota(by_place.begin(), by_place.end(), 0);
  std::stable_sort(by_place.begin(), by_place.end(),
                   [&](auto left, auto right) { return heights[left] > heights[right]; });
  std::vector<types::global_dof_index> last;
  for (unsigned int place = 0; place < nodes.size(); ++place) {
    place_of_dof[nodes[by_place[place]].dof] = place;
    last.push_back(nodes[by_place[place]].dof);
  }
  cholesky = std::make_unique<SparseCholesky>(space, std::move(last));
  cholesky->number_unknowns(space.constraints());
}

void DirectSolver::factorise(const Scene& scene) {
  if (!cholesky)
    number_unknowns(scene);
  angular_velocity.reset(); // until the factor is there
  is_reduced = false;
  schur.reset();
  {
    LowerTriplets triplets;
    {
      const Work::Phase phase(*work, "assembly");
      triplets = cholesky->assemble(space.constraints(), stiffness_products(space, scene));
      ++work->stiffness_assemblies;
    }
    const Work::Phase phase(*work, "ordering");
    cholesky->analyse(triplets, *work);
  }
  const Work::Phase phase(*work, "factorisation");
  cholesky->factorise(*work);
  schur = std::make_unique<DenseSchur>(cholesky->factor().trailing_factor(place_of_dof.size()));
  angular_velocity = scene.angular_velocity;
}

void DirectSolver::turn_to(const Scene& scene, const std::optional<FieldVector>& load, Work& work) {
  this->work = &work;
  if (angular_velocity != scene.angular_velocity)
    factorise(scene);
  places.clear();
  for (const SurfaceNode& node : space.contact_nodes())
    places.push_back(place_of_dof.at(node.dof));

  const Work::Phase phase(work, "contact");
  if (is_reduced && load.has_value() == this->load.has_value() &&
      (!load || std::equal(load->begin(), load->end(), this->load->begin())))
    return;
  this->load = load;
  const unsigned int m = schur->size();
  contact_load.reinit(m);
  reduced_load.clear();
  if (load) {
    reduced_load = cholesky->factor().forward(cholesky->gather(*load));
    ++work.forward_substitutions;
    contact_load = schur->multiply(Vector<double>(reduced_load.end() - m, reduced_load.end()));
  }
  is_reduced = true;
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
  FieldVector field = cholesky->scatter(cholesky->factor().backward(std::move(rhs)));
  space.constraints().distribute(field);
  return field;
}

FieldVector DirectSolver::apply(const FieldVector& field) const {
  return cholesky->scatter(cholesky->factor().multiply(cholesky->gather(field)));
}

} // namespace rollwave
