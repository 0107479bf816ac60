#include "direct_solver.h"

#include "assembly.h"
#include "memory.h"
#include "scene.h"

#include <numeric>

namespace rollwave {

using namespace dealii;

namespace {

/// Unknowns in the order of the degrees of freedom, but with the contact nodes last.
std::vector<int> number_unknowns(const RingSpace& space) {
  std::vector<int> unknown_of_dof(space.dof_handler().n_dofs(), 0);
  for (const auto& line : space.constraints().get_lines())
    unknown_of_dof[line.index] = -1;
  int contact_unknown = space.n_unknowns() - space.contact_nodes().size();
  for (const SurfaceNode& node : space.contact_nodes())
    unknown_of_dof[node.dof] = contact_unknown++;

  const int first_contact_unknown = space.n_unknowns() - space.contact_nodes().size();
  int unknown = 0;
  for (int& entry : unknown_of_dof)
    if (entry >= 0 && entry < first_contact_unknown)
      entry = unknown++;
  return unknown_of_dof;
}

/// The stiffness matrix of the unknowns: constrained degrees of freedom are replaced by the
/// combination of unknowns that their constraint names.
LowerTriplets assemble_triplets(const RingSpace& space, const Scene& scene,
                                const std::vector<int>& unknown_of_dof) {
  LowerTriplets triplets;
  const unsigned int dofs_per_cell = space.dof_handler().get_fe().n_dofs_per_cell();
  const std::size_t expected = space.dof_handler().get_triangulation().n_active_cells() *
                               (dofs_per_cell * (dofs_per_cell + 1) / 2);
  triplets.rows.reserve(expected);
  triplets.columns.reserve(expected);
  triplets.values.reserve(expected);

  std::vector<std::vector<std::pair<int, double>>> expansion(dofs_per_cell);
  assemble_stiffness(space, scene, [&](const auto& dofs, const FullMatrix<double>& cell_matrix) {
    for (unsigned int i = 0; i < dofs_per_cell; ++i) {
      expansion[i].clear();
      if (unknown_of_dof[dofs[i]] >= 0)
        expansion[i].emplace_back(unknown_of_dof[dofs[i]], 1.);
      else
        for (const auto& [dof, weight] : *space.constraints().get_constraint_entries(dofs[i]))
          expansion[i].emplace_back(unknown_of_dof[dof], weight);
    }
    for (unsigned int i = 0; i < dofs_per_cell; ++i)
      for (unsigned int j = 0; j < dofs_per_cell; ++j)
        for (const auto& [row, row_weight] : expansion[i])
          for (const auto& [column, column_weight] : expansion[j])
            if (row >= column)
              triplets.add(row, column, row_weight * column_weight * cell_matrix(i, j));
  });
  return triplets;
}

} // namespace

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
