#include "rollwave/solver/dense_schur.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <numeric>

namespace rollwave {

using namespace dealii;

/// sum of L_(row)j y_j over begin <= j < end
double DenseSchur::row_times(unsigned int row, unsigned int begin, unsigned int end,
                             const Vector<double>& y) const {
  const double* const entries = &factor(row, 0);
  return std::inner_product(entries + begin, entries + end, y.begin() + begin, 0.);
}

/// y_j -= L_(row)j times for begin <= j < end
void DenseSchur::subtract_row(unsigned int row, unsigned int begin, unsigned int end, double times,
                              Vector<double>& y) const {
  const double* const entries = &factor(row, 0);
  for (unsigned int j = begin; j < end; ++j)
    y(j) -= entries[j] * times;
}

/// Solves L y = y on the leading nodes.
void DenseSchur::forward(unsigned int end, Vector<double>& y) const {
  for (unsigned int i = 0; i < end; ++i)
    y(i) = (y(i) - row_times(i, 0, i, y)) / factor(i, i);
}

/// Solves L^T y = y on the leading nodes.
void DenseSchur::backward(unsigned int end, Vector<double>& y) const {
  for (unsigned int i = end; i-- > 0;) {
    y(i) /= factor(i, i);
    subtract_row(i, 0, i, y(i), y);
  }
}

unsigned int DenseSchur::solve(const std::vector<bool>& pinned, const Vector<double>& load,
                               Vector<double>& displacement, Vector<double>& force) const {
  const unsigned int m = size();
  AssertDimension(pinned.size(), m);
  const unsigned int first = std::find(pinned.begin(), pinned.end(), true) - pinned.begin();

  // Eliminate the nodes before the first pinned one: y = L^-1 (g - N), then what is left of g.
  Vector<double> y(m), remaining = load;
  for (unsigned int i = 0; i < first; ++i)
    y(i) = load(i) - force(i);
  forward(first, y);
  std::vector<unsigned int> free;
  for (unsigned int i = first; i < m; ++i) {
    remaining(i) -= row_times(i, 0, first, y);
    if (!pinned[i])
      free.push_back(i);
  }

  // L_TT^T u_T of the nodes T from the first pinned one on
  const auto transposed = [&](bool skip_free) {
    Vector<double> product(m);
    for (unsigned int i = first; i < m; ++i)
      if (pinned[i] || !skip_free)
        subtract_row(i, first, i + 1, -displacement(i), product);
    return product;
  };
  if (!free.empty()) {
    FullMatrix<double> rows(free.size(), m - first), block(free.size());
    for (unsigned int k = 0; k < free.size(); ++k)
      std::copy_n(&factor(free[k], first), free[k] + 1 - first, &rows(k, 0));
    rows.mTmult(block, rows);
    LAPACKFullMatrix<double> cholesky(free.size());
    cholesky = block;
    cholesky.set_property(LAPACKSupport::symmetric);
    cholesky.compute_cholesky_factorization();
    const Vector<double> of_pinned = transposed(true);
    Vector<double> rhs(free.size());
    for (unsigned int k = 0; k < free.size(); ++k)
      rhs(k) =
          remaining(free[k]) - force(free[k]) - row_times(free[k], first, free[k] + 1, of_pinned);
    cholesky.solve(rhs);
    for (unsigned int k = 0; k < free.size(); ++k)
      displacement(free[k]) = rhs(k);
  }
  const Vector<double> of_all = transposed(false);
  for (unsigned int i = first; i < m; ++i)
    if (pinned[i])
      force(i) = remaining(i) - row_times(i, first, i + 1, of_all);

  for (unsigned int i = first; i < m; ++i)
    subtract_row(i, 0, first, displacement(i), y);
  backward(first, y);
  std::copy_n(y.begin(), first, displacement.begin());
  return free.size();
}

Vector<double> DenseSchur::solve(Vector<double> force) const {
  forward(size(), force);
  backward(size(), force);
  return force;
}

Vector<double> DenseSchur::multiply(const Vector<double>& y) const {
  Vector<double> product(size());
  for (unsigned int i = 0; i < size(); ++i)
    product(i) = row_times(i, 0, i + 1, y);
  return product;
}

Vector<double> DenseSchur::transposed_multiply(const Vector<double>& u) const {
  Vector<double> product(size());
  for (unsigned int i = 0; i < size(); ++i)
    subtract_row(i, 0, i + 1, -u(i), product);
  return product;
}

} // namespace rollwave
