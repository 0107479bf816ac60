#include "rollwave/solver/system_matrix.h"

#include "rollwave/base/memory.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/run_statistics.h"
#include "rollwave/solver/condensed_system.h"

#include <string>
#include <utility>

namespace rollwave {

using namespace dealii;

SystemMatrix::SystemMatrix(const RingSpace& space, const AffineConstraints<double>& constraints,
                           const std::vector<SurfaceNode>& contact_nodes)
    : space(space), constraints(constraints), order(space, constraints, contact_nodes),
      combinations(space.dof_handler().get_fe().n_dofs_per_cell()) {
  const std::size_t n = combinations.size();
  triplets.reserve(n * (n + 1) / 2 * space.dof_handler().get_triangulation().n_active_cells());
}

void SystemMatrix::add(const std::vector<types::global_dof_index>& dofs,
                       const FullMatrix<double>& cell_matrix) {
  const auto unknown_of = [&](auto dof) { return order.unknown_of_dof[space.local_index(dof)]; };
  for (unsigned int i = 0; i < dofs.size(); ++i) {
    combinations[i].clear();
    if (const int unknown = unknown_of(dofs[i]); unknown >= 0)
      combinations[i].emplace_back(unknown, 1.);
    else
      for (const auto& [dof, weight] : *constraints.get_constraint_entries(dofs[i]))
        combinations[i].emplace_back(unknown_of(dof), weight);
  }
  for (unsigned int i = 0; i < dofs.size(); ++i)
    for (unsigned int j = 0; j < dofs.size(); ++j)
      for (const auto& [row, row_weight] : combinations[i])
        for (const auto& [column, column_weight] : combinations[j])
          if (row >= column)
            triplets.add(row, column, row_weight * column_weight * cell_matrix(i, j));
}

Vector<double> SystemMatrix::shift_diagonal() {
  Vector<double> shift(order.kept.rows.size());
  if (shift.size() == 0)
    return shift;
  const int first = order.n_unknowns - shift.size();
  for (std::size_t k = 0; k < triplets.values.size(); ++k)
    if (triplets.rows[k] == triplets.columns[k] && triplets.rows[k] >= first)
      shift(triplets.rows[k] - first) += triplets.values[k];
  for (unsigned int k = 0; k < shift.size(); ++k)
    triplets.add(first + k, first + k, shift(k));
  return shift;
}

std::unique_ptr<const SparseFactor> SystemMatrix::factorise(RunStatistics& statistics) {
  const MPI_Comm communicator = space.communicator();
  const int n = order.n_unknowns;
  const Vector<double> shift = shift_diagonal();
  CholmodFactor own(n, order.kept.size());
  // The triplets' memory is free after it.
  do_on_all(communicator, [&] { own.set_matrix(std::exchange(triplets, {})); });
  ++statistics.orderings;
  require_memory(sizeof(double) * own.n_factor_entries() +
                     dense_bytes(order.kept.size(), order.kept.rows.size()),
                 "the factor for " + std::to_string(n) + " unknowns", communicator);
  do_on_all(communicator, [&] { own.factorise(); });
  ++statistics.factorisations;
  return std::make_unique<SparseFactor>(space, std::move(order), std::move(own), shift);
}

} // namespace rollwave
