#include "rollwave/solver/interface_solver.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <Amesos.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

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
    : rows(rows), own_rows(own_rows), communicator(communicator), own(rows.size()) {
  IndexSet used_rows(own_rows.size());
  used_rows.add_indices(rows.begin(), rows.end());
  matrix.reinit(make_pattern(rows, own_rows, used_rows, communicator));
  with_ghosts.reinit(own_rows, used_rows, communicator);
  problem.SetOperator(const_cast<Epetra_CrsMatrix*>(&matrix.trilinos_matrix()));
  mumps.reset(Amesos().Create("Amesos_Mumps", problem));
  if (!mumps)
    throw NotSolved("Trilinos has been built without MUMPS, which several processes need");
  Teuchos::ParameterList parameters;
  // MUMPS reckons its memory from the analysis and spreads the work as it goes: with the usual 20 %
  // more than reckoned it runs short now and then on 16 processes.
  parameters.sublist("mumps").set("ICNTL(14)", 200);
  mumps->SetParameters(parameters);
  check(mumps->SymbolicFactorization(), "analysis", communicator);
}

void InterfaceSolver::set_matrix(const LAPACKFullMatrix<double>& part,
                                 const std::vector<bool>& is_given) {
  for (unsigned int j = 0; j < rows.size(); ++j)
    for (unsigned int i = 0; i < rows.size(); ++i)
      own(i, j) = !is_given[i] && !is_given[j]             ? part(i, j)
                  : i == j && own_rows.is_element(rows[i]) ? 1
                                                           : 0;
  if (factor == Factor::of_matrix)
    factor = Factor::of_earlier_matrix;
}

void InterfaceSolver::factorise() {
  matrix = 0;
  std::vector<double> values(rows.size());
  for (unsigned int i = 0; i < rows.size(); ++i) {
    for (unsigned int j = 0; j < rows.size(); ++j)
      values[j] = own(i, j);
    matrix.add(rows[i], rows.size(), rows.data(), values.data(), /*elide_zero_values=*/true,
               /*col_indices_are_sorted=*/true);
  }
  matrix.compress(VectorOperation::add);
  check(mumps->NumericFactorization(), "factorisation", communicator);
  factor = Factor::of_matrix;
}

void InterfaceSolver::apply_factor(Vector& x, const Vector& b) {
  problem.SetLHS(&x.trilinos_vector());
  problem.SetRHS(const_cast<Epetra_MultiVector*>(&b.trilinos_vector()));
  check(mumps->Solve(), "solution", communicator);
}

dealii::Vector<double> InterfaceSolver::of_this_process(const Vector& x) {
  with_ghosts = x;
  dealii::Vector<double> values(rows.size());
  for (unsigned int i = 0; i < rows.size(); ++i)
    values(i) = with_ghosts(rows[i]);
  return values;
}

void InterfaceSolver::sum_up(const dealii::Vector<double>& part, Vector& sum) const {
  sum = 0;
  for (unsigned int i = 0; i < rows.size(); ++i)
    sum(rows[i]) += part(i);
  sum.compress(VectorOperation::add);
}

/// T x
void InterfaceSolver::apply(Vector& product, const Vector& x) {
  const dealii::Vector<double> values = of_this_process(x);
  dealii::Vector<double> part(rows.size());
  if (!rows.empty())
    own.vmult(part, values);
  sum_up(part, product);
}

/// @return false where conjugate gradients do not converge soon
bool InterfaceSolver::iterate(Vector& x, const Vector& b) {
  struct Matrix {
    InterfaceSolver& solver;
    void vmult(Vector& product, const Vector& x) const { solver.apply(product, x); }
  };
  struct Preconditioner {
    InterfaceSolver& solver;
    void vmult(Vector& x, const Vector& b) const { solver.apply_factor(x, b); }
  };
  constexpr unsigned int most_steps = 30;
  constexpr double round_off = 1e-15;
  SolverControl control(most_steps, round_off * b.l2_norm());
  try {
    SolverCG<Vector>(control).solve(Matrix{*this}, x, b, Preconditioner{*this});
  } catch (const SolverControl::NoConvergence&) {
    return false;
  }
  return true;
}

dealii::Vector<double> InterfaceSolver::solve(const dealii::Vector<double>& part) {
  Vector b(own_rows, communicator), x(own_rows, communicator);
  sum_up(part, b);
  if (factor != Factor::of_earlier_matrix || !iterate(x, b)) {
    if (factor != Factor::of_matrix)
      factorise();
    apply_factor(x, b);
  }
  return of_this_process(x);
}

} // namespace rollwave
