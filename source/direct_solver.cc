#include "direct_solver.h"

#include "memory.h"
#include "stiffness_triplets.h"

#include <algorithm>

namespace rollwave {

using namespace dealii;

DirectSolver::DirectSolver(const RingSpace& space, const Scene& scene,
                           const std::optional<FieldVector>& load, Work& work)
    : space(space), work(work), unknown_of_dof(number_unknowns(space)) {
  const unsigned int m = space.contact_nodes().size();
  {
    LowerTriplets triplets;
    {
      const Work::Phase phase(work, "assembly");
      triplets = assemble_triplets(space, scene, unknown_of_dof);
      ++work.stiffness_assemblies;
    }
    const Work::Phase phase(work, "ordering");
    cholesky = std::make_unique<SparseCholesky>(space.n_unknowns(), m, triplets);
  }
  {
    const Work::Phase phase(work, "factorisation");
    // L; then S, its factor L_cc and the factor of its block of free nodes
    require_memory(sizeof(double) * (cholesky->n_factor_entries() + 3. * m * m),
                   "the factor of the stiffness matrix with " + std::to_string(m) +
                       " contact nodes");
    cholesky->factorise();
    ++work.factorisations;
  }

  const Work::Phase phase(work, "contact");
  trailing = cholesky->trailing_factor();
  schur.reinit(m, m);
  trailing.mTmult(schur, trailing);
  contact_load.reinit(m);
  if (load) {
    reduced_load = cholesky->forward(gather(*load));
    ++work.forward_substitutions;
    const Vector<double> reduced(reduced_load.end() - m, reduced_load.end());
    trailing.vmult(contact_load, reduced);
  }
}

void DirectSolver::factorise_free_block(const std::vector<bool>& pinned) {
  if (free_block && free_block->pinned == pinned)
    return;
  free_block.emplace();
  free_block->pinned = pinned;
  auto& nodes = free_block->nodes;
  for (unsigned int i = 0; i < pinned.size(); ++i)
    if (!pinned[i])
      nodes.push_back(i);
  if (nodes.empty())
    return;
  free_block->factor.reinit(nodes.size());
  for (unsigned int i = 0; i < nodes.size(); ++i)
    for (unsigned int j = 0; j < nodes.size(); ++j)
      free_block->factor(i, j) = schur(nodes[i], nodes[j]);
  free_block->factor.set_property(LAPACKSupport::symmetric);
  free_block->factor.compute_cholesky_factorization();
  ++work.dense_factorisations;
}

Vector<double> DirectSolver::response(const Vector<double>& force) {
  factorise_free_block(std::vector<bool>(force.size(), false));
  Vector<double> displacement = force;
  free_block->factor.solve(displacement);
  return displacement;
}

void DirectSolver::solve(const std::vector<bool>& pinned, ContactState& state) {
  const unsigned int m = contact_load.size();
  AssertDimension(pinned.size(), m);
  factorise_free_block(pinned);

  const auto& nodes = free_block->nodes;
  if (!nodes.empty()) {
    Vector<double> pinned_part(m), reaction(m), rhs(nodes.size());
    for (unsigned int i = 0; i < m; ++i)
      pinned_part(i) = pinned[i] ? state.displacement(i) : 0.;
    schur.vmult(reaction, pinned_part);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      rhs(i) = contact_load(nodes[i]) - state.force(nodes[i]) - reaction(nodes[i]);
    free_block->factor.solve(rhs);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      state.displacement(nodes[i]) = rhs(i);
  }

  Vector<double> internal_force(m);
  schur.vmult(internal_force, state.displacement);
  for (unsigned int i = 0; i < m; ++i)
    if (pinned[i])
      state.force(i) = contact_load(i) - internal_force(i);
}

FieldVector DirectSolver::displacement_field(const ContactState& state) {
  const Work::Phase phase(work, "back-substitution");
  const unsigned int m = contact_load.size();
  std::vector<double> rhs =
      reduced_load.empty() ? std::vector<double>(space.n_unknowns(), 0.) : reduced_load;
  // With this right-hand side the last rows of L^T x = rhs return the displacement given.
  Vector<double> trailing_rhs(m);
  trailing.Tvmult(trailing_rhs, state.displacement);
  std::copy(trailing_rhs.begin(), trailing_rhs.end(), rhs.end() - m);
  ++work.back_substitutions;
  return scatter(cholesky->backward(rhs));
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
