#ifndef ROLLWAVE_BANDED_MATRIX_H
#define ROLLWAVE_BANDED_MATRIX_H

#include <vector>

namespace rollwave {

/**
 * A symmetric positive semidefinite matrix A with A(i, j) = 0 for |i - j| > w, as the matrices of
 * elements in a row are. It grows by rows at its end.
 */
class BandedMatrix {
public:
  /// @param width w
  explicit BandedMatrix(unsigned int width) : stride(width + 1), entries(width * stride) {}

  unsigned int size() const { return entries.size() / stride - (stride - 1); }

  /// Appends rows of zeros.
  void grow(unsigned int rows) { entries.resize(entries.size() + rows * stride); }

  /// A(i, i + d), 0 <= d <= w, of which one is meant by A(i + d, i) as well.
  double& operator()(unsigned int i, unsigned int d) { return entries[i * stride + d]; }
  double operator()(unsigned int i, unsigned int d) const { return entries[i * stride + d]; }

  /// Sets the row and the column @p i to zero, of A or, where A ties it to no row after it, of its
  /// factors.
  void clear(unsigned int i);

  /// A += factor B, of the same size and width.
  void add(double factor, const BandedMatrix& other);

  /// A x
  std::vector<double> multiply(const std::vector<double>& x) const;

  /// Replaces A by the factors of A = L D L^T, rows of zeros left out.
  void factorise();

  /// A^-1 b, after factorise(); b itself in rows of zeros.
  std::vector<double> solve(std::vector<double> b) const;

  /// L^-T b, after factorise(), where L has no entries in rows of zeros.
  std::vector<double> solve_transposed(std::vector<double> b) const;

private:
  unsigned int stride;         ///< w + 1
  std::vector<double> entries; ///< of the upper triangle by rows, and w rows of zeros to read from
};

} // namespace rollwave

#endif
