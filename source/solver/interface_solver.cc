#include "rollwave/solver/interface_solver.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <Amesos.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <string>

namespace rollwave {

using namespace dealii;

namespace {

TrilinosWrappers::SparsityPattern make_pattern(const std::vector<types::global_dof_index>& rows,
                                               const IndexSet& own_rows, const IndexSet& used_rows,
                                               MPI_Comm communicator) {
  // deal.II refuses a number of entries where a process has no row.
  TrilinosWrappers::SparsityPattern pattern(own_rows, own_rows, used_rows, communicator,
                                            own_rows.n_elements() > 0 ? rows.size() : 0);
  for (const auto row : rows)
    pattern.add_entries(row, rows.begin(), rows.end(), /*indices_are_sorted=*/true);
  pattern.compress();
  return pattern;
}

/// @param status of Amesos on this process @throws NotSolved on all processes if one has an error
void check(int status, const std::string& step, MPI_Comm communicator) {
  if (holds_on_all(communicator, status == 0))
    return;
  const std::string error = first_text(communicator, status == 0 ? "" : std::to_string(status));
  throw NotSolved("the " + step + " of the matrix between processes failed in Amesos, status " +
                  error + "; use fewer unknowns or fewer processes");
}

} // namespace

InterfaceSolver::InterfaceSolver(const std::vector<types::global_dof_index>& rows,
                                 const IndexSet& own_rows, MPI_Comm communicator)
    : rows(rows), own_rows(own_rows), communicator(communicator) {
  IndexSet used_rows(own_rows.size());
  used_rows.add_indices(rows.begin(), rows.end());
  matrix.reinit(make_pattern(rows, own_rows, used_rows, communicator));
  rhs.reinit(own_rows, communicator);
  solution.reinit(own_rows, communicator);
  solution_with_ghosts.reinit(own_rows, used_rows, communicator);
  problem.SetOperator(const_cast<Epetra_CrsMatrix*>(&matrix.trilinos_matrix()));
  problem.SetLHS(&solution.trilinos_vector());
  problem.SetRHS(&rhs.trilinos_vector());
  mumps.reset(Amesos().Create("Amesos_Mumps", problem));
  if (!mumps)
    throw NotSolved("Trilinos has been built without MUMPS, which several processes need");
  Teuchos::ParameterList parameters;
  parameters.set("MatrixProperty", "SPD");
  mumps->SetParameters(parameters);
  check(mumps->SymbolicFactorization(), "analysis", communicator);
}

void InterfaceSolver::factorise(const LAPACKFullMatrix<double>& part,
                                const std::vector<bool>& is_given) {
  matrix = 0;
  std::vector<double> values(rows.size());
  for (unsigned int i = 0; i < rows.size(); ++i) {
    for (unsigned int j = 0; j < rows.size(); ++j)
      values[j] = is_given[i] || is_given[j] ? 0 : part(i, j);
    if (is_given[i] && own_rows.is_element(rows[i]))
      values[i] = 1;
    matrix.add(rows[i], rows.size(), rows.data(), values.data(), /*elide_zero_values=*/true,
               /*col_indices_are_sorted=*/true);
  }
  matrix.compress(VectorOperation::add);
  check(mumps->NumericFactorization(), "factorisation", communicator);
}

Vector<double> InterfaceSolver::solve(const Vector<double>& part) {
  rhs = 0;
  for (unsigned int i = 0; i < rows.size(); ++i)
    rhs(rows[i]) += part(i);
  rhs.compress(VectorOperation::add);
  check(mumps->Solve(), "solution", communicator);
  solution_with_ghosts = solution;
  Vector<double> of_this_process(rows.size());
  for (unsigned int i = 0; i < rows.size(); ++i)
    of_this_process(i) = solution_with_ghosts(rows[i]);
  return of_this_process;
}

} // namespace rollwave
