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

FieldVector SerialFactor::solve(const FieldVector* rhs, const Vector<double>& contact_values,
                                RunStatistics& statistics) const {
  ++statistics.sparse_solves;
  // L^T x = y with y_i = (L^-1 rhs)_i and y_c = L_cc^T x_c
  std::vector<double> y =
      rhs ? cholesky.forward(gather(*rhs)) : std::vector<double>(order.n_unknowns);
  if (order.n_last > 0) {
    Vector<double> last(order.n_last);
    schur_factor().Tvmult(last, contact_values);
    std::copy(last.begin(), last.end(), y.end() - order.n_last);
  }
  std::vector<double> x = cholesky.backward(std::move(y));
  std::copy(contact_values.begin(), contact_values.end(), x.end() - order.n_last);
  return scatter(x);
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
