#include "banded_matrix.h"

#include <cstddef>
#include <utility>

namespace rollwave {

void BandedMatrix::clear(unsigned int i) {
  for (unsigned int d = 0; d < stride; ++d) {
    (*this)(i, d) = 0;
    if (d <= i)
      (*this)(i - d, d) = 0;
  }
}

void BandedMatrix::add(double factor, const BandedMatrix& other) {
  for (std::size_t i = 0; i < entries.size(); ++i)
    entries[i] += factor * other.entries[i];
}

std::vector<double> BandedMatrix::multiply(const std::vector<double>& x) const {
  const unsigned int n = size();
  std::vector<double> product(n + stride - 1), padded(x);
  padded.resize(n + stride - 1);
  for (unsigned int i = 0; i < n; ++i) {
    product[i] += (*this)(i, 0) * padded[i];
    for (unsigned int d = 1; d < stride; ++d) {
      product[i] += (*this)(i, d) * padded[i + d];
      product[i + d] += (*this)(i, d) * padded[i];
    }
  }
  product.resize(n);
  return product;
}

void BandedMatrix::factorise() {
  for (unsigned int i = 0; i < size(); ++i) {
    const double pivot = (*this)(i, 0);
    if (pivot == 0)
      continue;
    for (unsigned int d = 1; d < stride; ++d) {
      const double multiplier = (*this)(i, d) / pivot;
      for (unsigned int e = d; e < stride; ++e)
        (*this)(i + d, e - d) -= multiplier * (*this)(i, e);
    }
    for (unsigned int d = 1; d < stride; ++d)
      (*this)(i, d) /= pivot;
  }
}

std::vector<double> BandedMatrix::solve(std::vector<double> b) const {
  const unsigned int n = size();
  b.resize(n + stride - 1);
  for (unsigned int i = 0; i < n; ++i) {
    for (unsigned int d = 1; d < stride; ++d)
      b[i + d] -= (*this)(i, d) * b[i];
    if (const double pivot = (*this)(i, 0); pivot != 0)
      b[i] /= pivot;
  }
  b.resize(n);
  return solve_transposed(std::move(b));
}

std::vector<double> BandedMatrix::solve_transposed(std::vector<double> b) const {
  const unsigned int n = size();
  b.resize(n + stride - 1);
  for (unsigned int i = n; i-- > 0;)
    for (unsigned int d = 1; d < stride; ++d)
      b[i] -= (*this)(i, d) * b[i + d];
  b.resize(n);
  return b;
}

} // namespace rollwave
