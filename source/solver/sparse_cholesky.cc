#include "rollwave/solver/sparse_cholesky.h"

#include "rollwave/base/memory.h"

#include <string>
#include <utility>

namespace rollwave {

using namespace dealii;

void SparseCholesky::number_unknowns(const AffineConstraints<double>& constraints) {
  if (cholesky)
    return;
  unknown_of_dof.assign(space.dof_handler().n_dofs(), -1);
  constexpr int later = -2;
  for (const SurfaceNode& node : last)
    unknown_of_dof[node.dof] = later;
  int n_unknowns = 0;
  for (const auto dof : space.elimination_order())
    if (unknown_of_dof[dof] != later && !constraints.is_constrained(dof))
      unknown_of_dof[dof] = n_unknowns++;
  for (const SurfaceNode& node : last)
    unknown_of_dof[node.dof] = n_unknowns++;
  cholesky = std::make_unique<CholmodFactor>(n_unknowns);
}

LowerTriplets SparseCholesky::assemble(const AffineConstraints<double>& constraints,
                                       const CellMatrices& matrices) const {
  const unsigned int n = space.dof_handler().get_fe().n_dofs_per_cell();
  LowerTriplets triplets;
  triplets.reserve(n * (n + 1) / 2 *
                   std::size_t(space.dof_handler().get_triangulation().n_active_cells()));
  // For each degree of freedom of a cell the unknown that it is, or the combination of unknowns
  // that its constraint names.
  std::vector<std::vector<std::pair<int, double>>> combinations(n);
  matrices([&](const auto& dofs, const FullMatrix<double>& matrix) {
    for (unsigned int i = 0; i < n; ++i) {
      combinations[i].clear();
      if (unknown_of_dof[dofs[i]] >= 0)
        combinations[i].emplace_back(unknown_of_dof[dofs[i]], 1.);
      else
        for (const auto& [dof, weight] : *constraints.get_constraint_entries(dofs[i]))
          combinations[i].emplace_back(unknown_of_dof[dof], weight);
    }
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        for (const auto& [row, row_weight] : combinations[i])
          for (const auto& [column, column_weight] : combinations[j])
            if (row >= column)
              triplets.add(row, column, row_weight * column_weight * matrix(i, j));
  });
  return triplets;
}

void SparseCholesky::analyse(const LowerTriplets& triplets, RunStatistics& statistics) {
  const bool is_first = cholesky->n_factor_entries() == 0;
  cholesky->set_matrix(triplets);
  if (!is_first) // later factors reuse the memory of the first
    return;
  ++statistics.orderings;
  constexpr double dense_matrices = 3; // of the last nodes: L_cc, S, and a block of S factorised
  const double n_entries =
      cholesky->n_factor_entries() + dense_matrices * last.size() * last.size();
  std::string purpose = "the factor for " + std::to_string(cholesky->size()) + " unknowns";
  if (!last.empty())
    purpose += " with " + std::to_string(last.size()) + " contact nodes";
  require_memory(sizeof(double) * n_entries, purpose);
}

void SparseCholesky::factorise(RunStatistics& statistics) {
  cholesky->factorise();
  ++statistics.factorisations;
}

void SparseCholesky::set_matrix(const AffineConstraints<double>& constraints,
                                const CellMatrices& matrices, RunStatistics& statistics) {
  number_unknowns(constraints);
  analyse(assemble(constraints, matrices), statistics);
  factorise(statistics);
}

FieldVector SparseCholesky::solve(const FieldVector& rhs, RunStatistics& statistics) {
  ++statistics.forward_substitutions;
  ++statistics.back_substitutions;
  return scatter(cholesky->backward(cholesky->forward(gather(rhs))));
}

std::vector<double> SparseCholesky::gather(const FieldVector& field) const {
  std::vector<double> unknowns(cholesky->size());
  for (unsigned int dof = 0; dof < unknown_of_dof.size(); ++dof)
    if (unknown_of_dof[dof] >= 0)
      unknowns[unknown_of_dof[dof]] = field(dof);
  return unknowns;
}

FieldVector SparseCholesky::scatter(const std::vector<double>& unknowns) const {
  FieldVector field = space.make_field();
  for (unsigned int dof = 0; dof < unknown_of_dof.size(); ++dof)
    if (unknown_of_dof[dof] >= 0)
      field(dof) = unknowns[unknown_of_dof[dof]];
  return field;
}

} // namespace rollwave
