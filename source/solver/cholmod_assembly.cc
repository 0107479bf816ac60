#include "rollwave/solver/cholmod_assembly.h"

#include "rollwave/mesh/assembly.h"
#include "rollwave/scene/scene.h"

#include <algorithm>
#include <utility>

namespace rollwave {

using namespace dealii;

std::vector<int> number_unknowns(const RingSpace& space, const Scene& scene) {
  std::vector<std::pair<double, types::global_dof_index>> contact;
  for (const SurfaceNode& node : space.candidate_nodes())
    contact.emplace_back(-scene.road(node.angle), node.dof);
  std::stable_sort(contact.begin(), contact.end(),
                   [](const auto& left, const auto& right) { return left.first < right.first; });
  std::vector<int> unknown_of_dof(space.dof_handler().n_dofs(), -1);
  int unknown = space.n_unknowns() - contact.size();
  for (const auto& node : contact)
    unknown_of_dof[node.second] = unknown++;
  unknown = 0;
  for (const auto dof : space.elimination_order())
    if (unknown_of_dof[dof] < 0 && !space.constraints().is_constrained(dof))
      unknown_of_dof[dof] = unknown++;
  return unknown_of_dof;
}

TripletAssembler::TripletAssembler(const RingSpace& space,
                                   const AffineConstraints<double>& constraints,
                                   const std::vector<int>& unknown_of_dof)
    : constraints(constraints), unknown_of_dof(unknown_of_dof),
      unknowns(space.dof_handler().get_fe().n_dofs_per_cell()),
      expansion(space.dof_handler().get_fe().n_dofs_per_cell()) {
  const std::size_t expected = space.dof_handler().get_triangulation().n_active_cells() *
                               (expansion.size() * (expansion.size() + 1) / 2);
  triplets.rows.reserve(expected);
  triplets.columns.reserve(expected);
  triplets.values.reserve(expected);
}

void TripletAssembler::add(const std::vector<types::global_dof_index>& dofs,
                           const FullMatrix<double>& cell_matrix) {
  bool is_free = true;
  for (unsigned int i = 0; i < dofs.size(); ++i) {
    unknowns[i] = unknown_of_dof[dofs[i]];
    is_free = is_free && unknowns[i] >= 0;
  }
  if (is_free) { // as most cells are
    for (unsigned int i = 0; i < dofs.size(); ++i)
      for (unsigned int j = 0; j <= i; ++j)
        triplets.add(std::max(unknowns[i], unknowns[j]), std::min(unknowns[i], unknowns[j]),
                     cell_matrix(i, j));
    return;
  }
  for (unsigned int i = 0; i < dofs.size(); ++i) {
    expansion[i].clear();
    if (unknowns[i] >= 0)
      expansion[i].emplace_back(unknowns[i], 1.);
    else
      for (const auto& [dof, weight] : *constraints.get_constraint_entries(dofs[i]))
        expansion[i].emplace_back(unknown_of_dof[dof], weight);
  }
  for (unsigned int i = 0; i < dofs.size(); ++i)
    for (unsigned int j = 0; j < dofs.size(); ++j)
      for (const auto& [row, row_weight] : expansion[i])
        for (const auto& [column, column_weight] : expansion[j])
          if (row >= column)
            triplets.add(row, column, row_weight * column_weight * cell_matrix(i, j));
}

LowerTriplets assemble_triplets(const RingSpace& space, const Scene& scene,
                                const std::vector<int>& unknown_of_dof) {
  TripletAssembler assembler(space, space.constraints(), unknown_of_dof);
  add_cell_matrices(space, stiffness_products(space, scene),
                    [&](const auto& dofs, const FullMatrix<double>& cell_matrix) {
                      assembler.add(dofs, cell_matrix);
                    });
  return std::move(assembler.triplets);
}

} // namespace rollwave
