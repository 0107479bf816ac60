#ifndef ROLLWAVE_SOLVER_BANDED_CHOLESKY_H
#define ROLLWAVE_SOLVER_BANDED_CHOLESKY_H

#include <cstddef>
#include <vector>

namespace rollwave {

/**
 * A symmetric positive definite matrix A with A(i, j) = 0 for |i - j| > w, as the matrices of
 * elements in a row are, and its factors A = L L^T by LAPACK. It grows by rows at its end.
 */
class BandedMatrix {
public:
  /// @param width w
  explicit BandedMatrix(unsigned int width) : stride(width + 1) {}

  unsigned int size() const { return entries.size() / stride; }

  /// Appends rows of zeros.
  void grow(unsigned int rows) { entries.resize(entries.size() + std::size_t(rows) * stride); }

  /// A(i + d, i), 0 <= d <= w, of which one is meant by A(i, i + d) as well.
  double& operator()(unsigned int i, unsigned int d) {
    return entries[std::size_t(i) * stride + d];
  }
  double operator()(unsigned int i, unsigned int d) const {
    return entries[std::size_t(i) * stride + d];
  }

  /// Makes the row and the column @p i those of the unit matrix: of A or, where A ties it to no row
  /// after it, of L.
  void clear(unsigned int i);

  /// A x
  std::vector<double> multiply(const std::vector<double>& x) const;

  /// Replaces A by L.
  void factorise();

  /// A^-1 b, after factorise().
  std::vector<double> solve(std::vector<double> b) const;

  /// By how much the minimiser x of x^T A x / 2 - b^T x changes when its values in some rows,
  /// before which A ties rows and behind which it does not, are given a @p change; after
  /// factorise().
  std::vector<double> follow(std::vector<double> change) const;

private:
  unsigned int stride;         ///< w + 1
  std::vector<double> entries; ///< LAPACK's band storage of the lower triangle
};

} // namespace rollwave

#endif
