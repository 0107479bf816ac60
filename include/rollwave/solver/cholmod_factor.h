#pragma once

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace rollwave {

/// Entries of the lower triangle of a symmetric matrix in any order; equal places are summed.
struct LowerTriplets {
  std::vector<int> rows;
  std::vector<int> columns;
  std::vector<double> values;

  void reserve(std::size_t size) {
    rows.reserve(size);
    columns.reserve(size);
    values.reserve(size);
  }

  void add(int row, int column, double value) {
    rows.push_back(row);
    columns.push_back(column);
    values.push_back(value);
  }
};

/**
 * The factorisation K = L L^T of a sparse symmetric positive definite matrix K of n rows by
 * CHOLMOD's supernodal method (Y. Chen, T. A. Davis, W. W. Hager and S. Rajamanickam, ACM Trans.
 * Math. Softw. 35 (2008) 22), which eliminates the unknowns in the order given. The last m of them
 * (c) are parted from the others (i), and L_cc is the factor of their Schur complement S:
 *
 *         ( L_ii       )
 *     L = (            ),     S = L_cc L_cc^T = K_cc - K_ci K_ii^-1 K_ic.
 *         ( L_ci  L_cc )
 */
class CholmodFactor {
public:
  CholmodFactor(int n, int m);
  CholmodFactor(CholmodFactor&& other) noexcept;
  ~CholmodFactor();

  /// Sums up the triplets to K and analyses it. @throws NotEnoughMemory
  void set_matrix(const LowerTriplets& triplets);

  /// Computes L. @throws NotSolved where K is not positive definite in rounded arithmetic,
  /// NotEnoughMemory
  void factorise();

  /// K x
  std::vector<double> multiply(std::vector<double> x) const;

  /// b_c - K_ci K_ii^-1 b_i
  dealii::Vector<double> condense(std::vector<double> b) const;

  /// x with the given x_c, where K_ii x_i = b_i - K_ic x_c. @param b empty for zero
  std::vector<double> solve(std::vector<double> b, const dealii::Vector<double>& x_c) const;

  /// L_cc, m x m, with zeros above the diagonal.
  dealii::LAPACKFullMatrix<double> schur_factor() const;

  /// Entries of L, zeros within supernodes included, after set_matrix().
  double n_factor_entries() const;

private:
  struct Cholmod;
  std::unique_ptr<Cholmod> cholmod;
  int n, m;
};

} // namespace rollwave
