#pragma once

#include <deal.II/lac/full_matrix.h>

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
 * Math. Softw. 35 (2008) 22), which eliminates the unknowns in the order given. trailing_factor()
 * gives the factor L_cc of the Schur complement S of the last m unknowns:
 *
 *         ( L_ii       )
 *     L = (            ),     S = L_cc L_cc^T = K_cc - K_ci K_ii^-1 K_ic.
 *         ( L_ci  L_cc )
 */
class CholmodFactor {
public:
  explicit CholmodFactor(int n);
  CholmodFactor(CholmodFactor&& other) noexcept;
  ~CholmodFactor();

  /// Sums up the triplets to K and analyses it. @throws NotEnoughMemory
  void set_matrix(const LowerTriplets& triplets);

  /// Computes L. @throws NotSolved where K is not positive definite in rounded arithmetic,
  /// NotEnoughMemory
  void factorise();

  /// K x
  std::vector<double> multiply(std::vector<double> x) const;

  /// L^-1 b
  std::vector<double> forward(std::vector<double> b) const;

  /// L^-T y
  std::vector<double> backward(std::vector<double> y) const;

  /// L_cc, m x m, with zeros above the diagonal.
  dealii::FullMatrix<double> trailing_factor(int m) const;

  /// Entries of L, zeros within supernodes included, after set_matrix().
  double n_factor_entries() const;

private:
  struct Cholmod;
  std::unique_ptr<Cholmod> cholmod;
  int n;
};

} // namespace rollwave
