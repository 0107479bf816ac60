#include "rollwave/solver/distributed_factor.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/memory.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/run_statistics.h"
#include "rollwave/solver/dense_cholesky.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <algorithm>
#include <string>
#include <utility>

namespace rollwave {

using namespace dealii;

DistributedMatrix::DistributedMatrix(const RingSpace& space,
                                     const AffineConstraints<double>& constraints,
                                     const std::vector<SurfaceNode>& contact_nodes)
    : space(space), constraints(constraints),
      matrix(std::make_unique<TrilinosWrappers::SparseMatrix>()) {
  for (const SurfaceNode& node : contact_nodes)
    contact_rows.push_back(node.dof);
  const IndexSet& owned = space.dof_handler().locally_owned_dofs();
  TrilinosWrappers::SparsityPattern pattern(owned, owned, space.relevant_dofs(),
                                            space.communicator());
  DoFTools::make_sparsity_pattern(space.dof_handler(), pattern, constraints,
                                  /*keep_constrained_dofs=*/false);
  pattern.compress();
  matrix->reinit(pattern);
}

void DistributedMatrix::add(const std::vector<types::global_dof_index>& dofs,
                            const FullMatrix<double>& cell_matrix) {
  constraints.distribute_local_to_global(cell_matrix, dofs, *matrix);
}

namespace {

/// The lower triangle of the rows of this process.
LowerTriplets own_entries(const TrilinosWrappers::SparseMatrix& matrix) {
  const Epetra_CrsMatrix& rows = matrix.trilinos_matrix();
  const int *const row_numbers = rows.RowMap().MyGlobalElements(), *const column_numbers =
                                                                       rows.ColMap()
                                                                           .MyGlobalElements();
  LowerTriplets triplets;
  triplets.reserve((rows.NumMyNonzeros() + rows.NumMyRows()) / 2);
  for (int i = 0; i < rows.NumMyRows(); ++i) {
    int n = 0, *columns = nullptr;
    double* values = nullptr;
    rows.ExtractMyRowView(i, n, values, columns);
    for (int k = 0; k < n; ++k)
      if (const int column = column_numbers[columns[k]]; column <= row_numbers[i])
        triplets.add(row_numbers[i], column, values[k]);
  }
  return triplets;
}

} // namespace

std::unique_ptr<const SparseFactor> DistributedMatrix::factorise(RunStatistics& statistics) {
  matrix->compress(VectorOperation::add);
  const int n = space.dof_handler().n_dofs();
  LowerTriplets entries = own_entries(*matrix);
  if (contact_rows.empty())
    matrix.reset(); // frees its memory first
  auto factor =
      std::make_unique<MumpsFactor>(space.communicator(), n, std::move(entries), contact_rows);
  ++statistics.orderings;
  require_memory(factor->needed_memory(),
                 "the factor for " + std::to_string(space.n_unknowns()) + " unknowns",
                 space.communicator());
  factor->factorise();
  ++statistics.factorisations;
  return std::make_unique<DistributedFactor>(space, contact_rows, std::move(matrix),
                                             std::move(factor));
}

DistributedFactor::DistributedFactor(const RingSpace& space, const std::vector<int>& contact_rows,
                                     std::unique_ptr<const TrilinosWrappers::SparseMatrix> matrix,
                                     std::unique_ptr<const MumpsFactor> factor)
    : space(space), contact_rows(contact_rows), matrix(std::move(matrix)),
      factor(std::move(factor)) {
  for (const IndexSet& owned :
       Utilities::MPI::all_gather(space.communicator(), space.dof_handler().locally_owned_dofs())) {
    first_owned.push_back(n_owned.empty() ? 0 : first_owned.back() + n_owned.back());
    n_owned.push_back(owned.n_elements());
  }
}

FieldVector DistributedFactor::solve(const FieldVector* rhs, const Vector<double>& contact_values,
                                     RunStatistics& statistics) const {
  ++statistics.sparse_solves;
  const auto set_contact_values = [&](FieldVector& field) {
    for (unsigned int i = 0; i < contact_rows.size(); ++i)
      if (field.in_local_range(contact_rows[i]))
        field(contact_rows[i]) = contact_values(i);
  };
  FieldVector x = space.make_field(), interior_rhs = space.make_field();
  if (!contact_rows.empty()) {
    set_contact_values(x);
    interior_rhs -= apply(x);
  }
  if (rhs)
    interior_rhs += *rhs;
  const MPI_Comm communicator = space.communicator();
  const int rank = process_number(communicator), n_own = n_owned[rank];
  std::vector<double> all(rank == 0 ? space.dof_handler().n_dofs() : 0);
  MPI_Gatherv(interior_rhs.begin(), n_own, MPI_DOUBLE, all.data(), n_owned.data(),
              first_owned.data(), MPI_DOUBLE, 0, communicator);
  all = factor->solve_interior(std::move(all));
  MPI_Scatterv(all.data(), n_owned.data(), first_owned.data(), MPI_DOUBLE, x.begin(), n_own,
               MPI_DOUBLE, 0, communicator);
  set_contact_values(x);
  return x;
}

FieldVector DistributedFactor::apply(const FieldVector& x) const {
  FieldVector product = space.make_field();
  matrix->vmult(product, x);
  space.constraints().set_zero(product);
  return product;
}

FullMatrix<double> DistributedFactor::schur_factor() const {
  const MPI_Comm communicator = space.communicator();
  const unsigned int m = contact_rows.size();
  FullMatrix<double> lower(m, m);
  std::string failure;
  if (process_number(communicator) == 0)
    try {
      LAPACKFullMatrix<double> schur(m);
      schur = factor->schur();
      factorise_dense(schur);
      for (unsigned int i = 0; i < m; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          lower(i, j) = schur(i, j);
    } catch (const NotSolved& not_definite) {
      failure = not_definite.what();
    }
  if (failure = broadcast(communicator, failure); !failure.empty())
    throw NotSolved(failure);
  // All processes get the same digits, so that they take the same decisions.
  MPI_Bcast(&lower(0, 0), m * m, MPI_DOUBLE, 0, communicator);
  return lower;
}

} // namespace rollwave
