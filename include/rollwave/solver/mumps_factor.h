#pragma once

#include "rollwave/solver/cholmod_factor.h"

#include <deal.II/lac/full_matrix.h>

#include <mpi.h>

#include <memory>
#include <vector>

namespace rollwave {

/**
 * The factorisation of a sparse symmetric positive definite matrix K of n rows on several processes
 * by MUMPS's multifrontal method (P. R. Amestoy, I. S. Duff, J.-Y. L'Excellent and J. Koster, SIAM
 * J. Matrix Anal. Appl. 23 (2001) 15-41), in the order of approximate minimum degree. Some rows
 * (c) are left out of the factorisation of the others (i), which gives their Schur complement S.
 *
 * The processes share the entries of K and the factors. Vectors and S are those of rank 0. All
 * processes must call all functions.
 */
class MumpsFactor {
public:
  /// Analyses K.
  /// @param own_entries those of this process
  /// @param contact_rows the rows c
  /// @throws NotEnoughMemory, NotSolved
  MumpsFactor(MPI_Comm communicator, int n, LowerTriplets own_entries,
              std::vector<int> contact_rows);
  ~MumpsFactor();
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;

  /// The memory that this process needs for the factorisation, in bytes.
  double needed_memory() const;

  /// Computes the factors and S. If MUMPS asks for more workspace, it gets twice as much.
  /// @param workspace percents of the estimated workspace to be added
  /// @throws NotSolved where K_ii is not positive definite in rounded arithmetic, NotEnoughMemory
  void factorise(int workspace = 20);

  /// x with K_ii x_i = rhs_i and x_c = 0, both on rank 0; the other ranks pass an empty vector.
  std::vector<double> solve_interior(std::vector<double> rhs) const;

  /// The lower triangle of S, on rank 0.
  const dealii::FullMatrix<double>& schur() const { return schur_complement; }

private:
  struct Mumps;
  std::unique_ptr<Mumps> mumps;
  LowerTriplets entries;         ///< until factorise(); rows and columns are numbered from 1
  std::vector<int> contact_rows; ///< numbered from 1
  dealii::FullMatrix<double> schur_complement;
};

} // namespace rollwave
