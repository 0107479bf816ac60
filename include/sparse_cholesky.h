#ifndef ROLLWAVE_SPARSE_CHOLESKY_H
#define ROLLWAVE_SPARSE_CHOLESKY_H

#include <deal.II/lac/full_matrix.h>

#include <memory>
#include <vector>

namespace rollwave {

/// Entries of the lower triangle of a symmetric matrix in any order; equal places are summed.
struct LowerTriplets {
  std::vector<int> rows;
  std::vector<int> columns;
  std::vector<double> values;

  void add(int row, int column, double value) {
    rows.push_back(row);
    columns.push_back(column);
    values.push_back(value);
  }
};

/**
 * The factorisation P K P^T = L L^T of a sparse symmetric positive definite matrix K of n rows,
 * which eliminates groups of unknowns one after another and the last m unknowns last, in their
 * order:
 *
 *         ( L_ii       )                        T
 *     L = (            ),     S = L_cc   L_cc
 *         ( L_ci  L_cc )
 *
 * where the m x m matrix S is the Schur complement of the leading unknowns. By CHOLMOD's supernodal
 * method with constrained approximate minimum degree ordering (Y. Chen, T. A. Davis, W. W. Hager
 * and S. Rajamanickam, ACM Trans. Math. Softw. 35 (2008) 22).
 */
class SparseCholesky {
public:
  /// The order of two unknowns is free within a group, and else that of their @p groups: n numbers
  /// from 0 on, of which the last m have no meaning.
  SparseCholesky(std::vector<int> groups, int m);
  ~SparseCholesky();

  /// Sums up the triplets to K and, unless its pattern is that of the matrix before, analyses it,
  /// after ordering the first one. @return whether it did. @throws NotSolved when memory is short.
  bool set_matrix(const LowerTriplets& triplets);

  /// Computes L. @throws NotSolved when K is not positive definite or memory is short.
  void factorise();

  std::size_t size() const { return n; }

  /// K x
  std::vector<double> multiply(const std::vector<double>& x) const;

  /// y = L^-1 P b, of size n; its last m entries belong to the trailing unknowns.
  std::vector<double> forward(const std::vector<double>& b);

  /// P^T L^-T y
  std::vector<double> backward(const std::vector<double>& y);

  /// L_cc, m x m, with zeros above the diagonal.
  dealii::FullMatrix<double> trailing_factor() const;

  /// Entries of L, zeros within supernodes included.
  double n_factor_entries() const;

private:
  struct Cholmod;
  std::vector<double> to_order(const std::vector<double>& x) const;
  std::vector<double> from_order(const std::vector<double>& x) const;

  std::unique_ptr<Cholmod> cholmod;
  std::size_t n;
  int m;
  std::vector<int> groups; ///< until the first matrix is ordered
  std::vector<int> order;  ///< which unknown is eliminated as the k-th; empty without a matrix
};

} // namespace rollwave

#endif
