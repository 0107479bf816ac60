#include "rollwave/solver/sparse_cholesky.h"

#include "rollwave/base/memory.h"

#include <algorithm>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// Adds up cell matrices to a matrix of the unknowns: constrained degrees of freedom are replaced
/// by the combination of unknowns that their constraint names.
class TripletAssembler {
public:
  TripletAssembler(const RingSpace& space, const AffineConstraints<double>& constraints,
                   const std::vector<int>& unknown_of_dof)
      : constraints(constraints), unknown_of_dof(unknown_of_dof),
        unknowns(space.dof_handler().get_fe().n_dofs_per_cell()), combinations(unknowns.size()) {
    const std::size_t expected = space.dof_handler().get_triangulation().n_active_cells() *
                                 (unknowns.size() * (unknowns.size() + 1) / 2);
    triplets.rows.reserve(expected);
    triplets.columns.reserve(expected);
    triplets.values.reserve(expected);
  }

  void add(const std::vector<types::global_dof_index>& dofs, const FullMatrix<double>& matrix) {
    bool is_free = true;
    for (unsigned int i = 0; i < dofs.size(); ++i) {
      unknowns[i] = unknown_of_dof[dofs[i]];
      is_free = is_free && unknowns[i] >= 0;
    }
    if (is_free) // as most cells are
      for (unsigned int i = 0; i < dofs.size(); ++i)
        for (unsigned int j = 0; j <= i; ++j)
          triplets.add(std::max(unknowns[i], unknowns[j]), std::min(unknowns[i], unknowns[j]),
                       matrix(i, j));
    else
      add_constrained(dofs, matrix);
  }

  LowerTriplets triplets;

private:
  void add_constrained(const std::vector<types::global_dof_index>& dofs,
                       const FullMatrix<double>& matrix) {
    for (unsigned int i = 0; i < dofs.size(); ++i) {
      combinations[i].clear();
      if (unknowns[i] >= 0)
        combinations[i].emplace_back(unknowns[i], 1.);
      else
        for (const auto& [dof, weight] : *constraints.get_constraint_entries(dofs[i]))
          combinations[i].emplace_back(unknown_of_dof[dof], weight);
    }
    for (unsigned int i = 0; i < dofs.size(); ++i)
      for (unsigned int j = 0; j < dofs.size(); ++j)
        for (const auto& [row, row_weight] : combinations[i])
          for (const auto& [column, column_weight] : combinations[j])
            if (row >= column)
              triplets.add(row, column, row_weight * column_weight * matrix(i, j));
  }

  const AffineConstraints<double>& constraints;
  const std::vector<int>& unknown_of_dof;
  std::vector<int> unknowns; ///< of the cell's degrees of freedom
  std::vector<std::vector<std::pair<int, double>>> combinations;
};

} // namespace

void SparseCholesky::number_unknowns(const AffineConstraints<double>& constraints) {
  unknown_of_dof.assign(space.dof_handler().n_dofs(), -1);
  constexpr int later = -2;
  for (const auto dof : last)
    unknown_of_dof[dof] = later;
  int n_unknowns = 0;
  for (const auto dof : space.elimination_order())
    if (unknown_of_dof[dof] != later && !constraints.is_constrained(dof))
      unknown_of_dof[dof] = n_unknowns++;
  for (const auto dof : last)
    unknown_of_dof[dof] = n_unknowns++;
  cholesky = std::make_unique<CholmodFactor>(n_unknowns);
}

LowerTriplets SparseCholesky::assemble(const AffineConstraints<double>& constraints,
                                       const RadialProducts& radial) const {
  TripletAssembler assembler(space, constraints, unknown_of_dof);
  add_cell_matrices(space, radial, [&](const auto& dofs, const FullMatrix<double>& cell_matrix) {
    assembler.add(dofs, cell_matrix);
  });
  return std::move(assembler.triplets);
}

void SparseCholesky::analyse(const LowerTriplets& triplets, Work& work) {
  const bool is_first = cholesky->n_factor_entries() == 0;
  cholesky->set_matrix(triplets);
  if (!is_first) // later factors take the place of the one before
    return;
  ++work.orderings;
  require_memory(sizeof(double) * (cholesky->n_factor_entries() + 1. * last.size() * last.size()),
                 last.empty() ? "the factor of the dual problem"
                              : "the factor of the stiffness matrix with " +
                                    std::to_string(last.size()) + " contact nodes");
}

void SparseCholesky::factorise(Work& work) {
  cholesky->factorise();
  ++work.factorisations;
}

void SparseCholesky::set_matrix(const Scene& /*scene*/,
                                const AffineConstraints<double>& constraints,
                                const RadialProducts& radial, Work& work) {
  if (!cholesky)
    number_unknowns(constraints);
  analyse(assemble(constraints, radial), work);
  factorise(work);
}

FieldVector SparseCholesky::solve(const FieldVector& rhs, Work& work) {
  ++work.forward_substitutions;
  ++work.back_substitutions;
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
