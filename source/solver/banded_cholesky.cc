#include "rollwave/solver/banded_cholesky.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

extern "C" {
void dpbtrf_(const char* triangle, const int* n, const int* width, double* band, const int* stride,
             int* info);
void dpbtrs_(const char* triangle, const int* n, const int* width, const int* n_rhs,
             const double* band, const int* stride, double* b, const int* ldb, int* info);
void dtbtrs_(const char* triangle, const char* transposed, const char* diagonal, const int* n,
             const int* width, const int* n_rhs, const double* band, const int* stride, double* b,
             const int* ldb, int* info);
void dsbmv_(const char* triangle, const int* n, const int* width, const double* alpha,
            const double* band, const int* stride, const double* x, const int* step_x,
            const double* beta, double* y, const int* step_y);
}

namespace rollwave {

namespace {

constexpr char lower = 'L';
constexpr int one = 1;

} // namespace

void BandedMatrix::clear(unsigned int i) {
  for (unsigned int d = 0; d < stride; ++d) {
    (*this)(i, d) = 0;
    if (d <= i)
      (*this)(i - d, d) = 0;
  }
  (*this)(i, 0) = 1;
}

std::vector<double> BandedMatrix::multiply(const std::vector<double>& x) const {
  std::vector<double> product(x.size());
  const int n = size(), width = stride - 1, ld = stride;
  const double factor = 1, keep = 0;
  dsbmv_(&lower, &n, &width, &factor, entries.data(), &ld, x.data(), &one, &keep, product.data(),
         &one);
  return product;
}

void BandedMatrix::factorise() {
  const int n = size(), width = stride - 1, ld = stride;
  int info = 0;
  // By as much as rounding may make a matrix indefinite that is hardly definite.
  constexpr double round_off = 1e-14;
  for (int i = 0; i < n; ++i)
    (*this)(i, 0) *= 1 + round_off;
  dpbtrf_(&lower, &n, &width, entries.data(), &ld, &info);
  AssertThrow(info == 0, dealii::ExcMessage("a banded matrix is not positive definite"));
}

std::vector<double> BandedMatrix::solve(std::vector<double> b) const {
  const int n = size(), width = stride - 1, ld = stride, ldb = std::max(n, 1);
  int info = 0;
  dpbtrs_(&lower, &n, &width, &one, entries.data(), &ld, b.data(), &ldb, &info);
  return b;
}

std::vector<double> BandedMatrix::follow(std::vector<double> change) const {
  constexpr char transposed = 'T', general = 'N';
  const int n = size(), width = stride - 1, ld = stride, ldb = std::max(n, 1);
  for (int i = 0; i < n; ++i)
    change[i] *= (*this)(i, 0);
  int info = 0;
  dtbtrs_(&lower, &transposed, &general, &n, &width, &one, entries.data(), &ld, change.data(), &ldb,
          &info);
  return change;
}

} // namespace rollwave
