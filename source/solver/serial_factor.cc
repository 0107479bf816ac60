#include "rollwave/solver/serial_factor.h"

#include "rollwave/base/memory.h"
#include "rollwave/base/run_statistics.h"

#include <algorithm>
#include <string>
#include <utility>

namespace rollwave {

using namespace dealii;

EliminationOrder::EliminationOrder(const RingSpace& space,
                                   const AffineConstraints<double>& constraints,
                                   const std::vector<SurfaceNode>& last)
    : n_last(last.size()), unknown_of_dof(space.dof_handler().n_dofs(), -1) {
  constexpr int later = -2;
  for (const SurfaceNode& node : last)
    unknown_of_dof[node.dof] = later;
  for (const auto dof : space.elimination_order())
    if (unknown_of_dof[dof] != later && !constraints.is_constrained(dof))
      unknown_of_dof[dof] = n_unknowns++;
  for (const SurfaceNode& node : last)
    unknown_of_dof[node.dof] = n_unknowns++;
}

SerialMatrix::SerialMatrix(const RingSpace& space, const AffineConstraints<double>& constraints,
                           const std::vector<SurfaceNode>& contact_nodes)
    : space(space), constraints(constraints), order(space, constraints, contact_nodes),
      combinations(space.dof_handler().get_fe().n_dofs_per_cell()) {
  const std::size_t n = combinations.size();
  triplets.reserve(n * (n + 1) / 2 * space.dof_handler().get_triangulation().n_active_cells());
}

void SerialMatrix::add(const std::vector<types::global_dof_index>& dofs,
                       const FullMatrix<double>& cell_matrix) {
  for (unsigned int i = 0; i < dofs.size(); ++i) {
    combinations[i].clear();
    if (const int unknown = order.unknown_of_dof[dofs[i]]; unknown >= 0)
      combinations[i].emplace_back(unknown, 1.);
    else
      for (const auto& [dof, weight] : *constraints.get_constraint_entries(dofs[i]))
        combinations[i].emplace_back(order.unknown_of_dof[dof], weight);
  }
  for (unsigned int i = 0; i < dofs.size(); ++i)
    for (unsigned int j = 0; j < dofs.size(); ++j)
      for (const auto& [row, row_weight] : combinations[i])
        for (const auto& [column, column_weight] : combinations[j])
          if (row >= column)
            triplets.add(row, column, row_weight * column_weight * cell_matrix(i, j));
}

std::unique_ptr<const SparseFactor> SerialMatrix::factorise(RunStatistics& statistics) {
  CholmodFactor cholesky(order.n_unknowns);
  cholesky.set_matrix(std::exchange(triplets, {})); // whose memory is free after it
  ++statistics.orderings;
  require_memory(sizeof(double) * cholesky.n_factor_entries(),
                 "the factor for " + std::to_string(order.n_unknowns) + " unknowns");
  cholesky.factorise();
  ++statistics.factorisations;
  return std::make_unique<SerialFactor>(space, std::move(order), std::move(cholesky));
}

SerialFactor::SerialFactor(const RingSpace& space, EliminationOrder order, CholmodFactor cholesky)
    : space(space), order(std::move(order)), cholesky(std::move(cholesky)) {}

FieldVector SerialFactor::solve_interior(const FieldVector& rhs, RunStatistics& statistics) const {
  ++statistics.sparse_solves;
  std::vector<double> values = cholesky.forward(gather(rhs));
  // With zeros in the last rows of L^T x = L^-1 rhs, x_c = 0 and L_ii^T x_i = (L^-1 rhs)_i.
  std::fill(values.end() - order.n_last, values.end(), 0.);
  return scatter(cholesky.backward(std::move(values)));
}

FieldVector SerialFactor::apply(const FieldVector& x) const {
  return scatter(cholesky.multiply(gather(x)));
}

FullMatrix<double> SerialFactor::schur_factor() const {
  return cholesky.trailing_factor(order.n_last);
}

std::vector<double> SerialFactor::gather(const FieldVector& field) const {
  std::vector<double> unknowns(order.n_unknowns);
  for (unsigned int dof = 0; dof < order.unknown_of_dof.size(); ++dof)
    if (order.unknown_of_dof[dof] >= 0)
      unknowns[order.unknown_of_dof[dof]] = field(dof);
  return unknowns;
}

FieldVector SerialFactor::scatter(const std::vector<double>& unknowns) const {
  FieldVector field = space.make_field();
  for (unsigned int dof = 0; dof < order.unknown_of_dof.size(); ++dof)
    if (order.unknown_of_dof[dof] >= 0)
      field(dof) = unknowns[order.unknown_of_dof[dof]];
  return field;
}

} // namespace rollwave
