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
 * (2001) 15-41). From one set of given unknowns to the next T changes by little: then the factor of
 * an earlier T preconditions conjugate gradients. All processes must call all functions.
 */
class InterfaceSolver {
public:
  /// Analyses T. @param rows of the unknowns of this process @param own_rows those that it holds
  /// @throws NotSolved
  InterfaceSolver(const std::vector<dealii::types::global_dof_index>& rows,
                  const dealii::IndexSet& own_rows, MPI_Comm communicator);

  /// Replaces T. The rows and columns of given unknowns become those of the identity.
  /// @param part of this process, by its rows
  void set_matrix(const dealii::LAPACKFullMatrix<double>& part, const std::vector<bool>& is_given);

  /// T^-1 b, where b is zero for given unknowns. T is factorised where there is no factor yet, or
  /// where conjugate gradients do not converge soon.
  /// @param part of b, which is the sum of all of them @throws NotEnoughMemory, NotSolved
  dealii::Vector<double> solve(const dealii::Vector<double>& part);

private:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  dealii::Vector<double> of_this_process(const Vector& x);
  void sum_up(const dealii::Vector<double>& part, Vector& sum) const;
  void apply(Vector& product, const Vector& x);
  void factorise();
  void apply_factor(Vector& x, const Vector& b);
  bool iterate(Vector& x, const Vector& b);

  const std::vector<dealii::types::global_dof_index> rows;
  const dealii::IndexSet own_rows;
  const MPI_Comm communicator;
  dealii::LAPACKFullMatrix<double> own;          ///< the part of this process of T
  dealii::TrilinosWrappers::SparseMatrix matrix; ///< T when it was factorised
  Vector with_ghosts;                            ///< values at the rows of this process
  Epetra_LinearProblem problem;
  std::unique_ptr<Amesos_BaseSolver> mumps;
  enum class Factor { none, of_earlier_matrix, of_matrix } factor = Factor::none;
};

} // namespace rollwave
