#pragma once

#include <deal.II/base/index_set.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>
#include <deal.II/lac/vector.h>

#include <Amesos_BaseSolver.h>
#include <Epetra_LinearProblem.h>

#include <memory>
#include <vector>

namespace rollwave {

/**
 * The linear system T x = b of the unknowns between several processes. T is the sum of dense
 * matrices, one of each process. Trilinos holds it with its rows distributed, and factorises it by
 * MUMPS (P. R. Amestoy, I. S. Duff, J. Koster and J.-Y. L'Excellent, SIAM J. Matrix Anal. Appl. 23
 * (2001) 15-41). All processes must call all functions.
 */
class InterfaceSolver {
public:
  /// Analyses T. @param rows of the unknowns of this process @param own_rows those that it holds
  /// @throws NotSolved
  InterfaceSolver(const std::vector<dealii::types::global_dof_index>& rows,
                  const dealii::IndexSet& own_rows, MPI_Comm communicator);

  /// Sums up T and factorises it. The rows and columns of given unknowns become those of the
  /// identity. @param part of this process, by its rows @throws NotEnoughMemory, NotSolved
  void factorise(const dealii::LAPACKFullMatrix<double>& part, const std::vector<bool>& is_given);

  /// T^-1 b of the factor made last, where no unknown is given by b.
  /// @param part of b, which is the sum of all of them @throws NotSolved
  dealii::Vector<double> solve(const dealii::Vector<double>& part);

private:
  const std::vector<dealii::types::global_dof_index> rows;
  const dealii::IndexSet own_rows;
  const MPI_Comm communicator;
  dealii::TrilinosWrappers::SparseMatrix matrix;
  dealii::TrilinosWrappers::MPI::Vector rhs, solution, solution_with_ghosts;
  Epetra_LinearProblem problem; ///< of the three
  std::unique_ptr<Amesos_BaseSolver> mumps;
};

} // namespace rollwave
