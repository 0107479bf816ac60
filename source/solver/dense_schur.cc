#include "rollwave/solver/dense_schur.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <Teuchos_BLAS.hpp>
#include <algorithm>

namespace rollwave {

using namespace dealii;

namespace {

using Teuchos::NO_TRANS, Teuchos::TRANS, Teuchos::LEFT_SIDE, Teuchos::UPPER_TRI,
    Teuchos::NON_UNIT_DIAG;

/// x <- L x (TRANS) or L^T x (NO_TRANS) with a triangle of n rows in the m of L, which BLAS reads
/// by columns, and so as L^T.
void multiply_triangle(const double* triangle, Teuchos::ETransp transposed, int m, int n,
                       double* x) {
  Teuchos::BLAS<int, double>().TRMM(LEFT_SIDE, UPPER_TRI, transposed, NON_UNIT_DIAG, n, 1, 1.,
                                    triangle, m, x, m);
}

/// The same with the inverse.
void divide_by_triangle(const double* triangle, Teuchos::ETransp transposed, int m, int n,
                        double* x) {
  Teuchos::BLAS<int, double>().TRSM(LEFT_SIDE, UPPER_TRI, transposed, NON_UNIT_DIAG, n, 1, 1.,
                                    triangle, m, x, m);
}

} // namespace

unsigned int DenseSchur::solve(const std::vector<bool>& pinned, const Vector<double>& load,
                               Vector<double>& displacement, Vector<double>& force) const {
  AssertDimension(pinned.size(), factor.m());
  // O: the nodes before the first pinned one, T: the others.
  const unsigned int m = factor.m(),
                     n_o = std::find(pinned.begin(), pinned.end(), true) - pinned.begin(),
                     n_t = m - n_o;
  const double *const l_oo = &factor(0, 0), *const l_to = l_oo + std::size_t(n_o) * m,
                      *const l_tt = l_to + n_o;

  // y = L_OO^-1 (g - N)_O, and what is left of g on T.
  Vector<double> y(load.begin(), load.begin() + n_o), remaining(load.begin() + n_o, load.end());
  for (unsigned int i = 0; i < n_o; ++i)
    y(i) -= force(i);
  divide_by_triangle(l_oo, TRANS, m, n_o, y.begin());
  Teuchos::BLAS<int, double>().GEMV(TRANS, n_o, n_t, -1., l_to, m, y.begin(), 1, 1.,
                                    remaining.begin(), 1);

  Vector<double> u(displacement.begin() + n_o, displacement.end());
  std::vector<unsigned int> free;
  for (unsigned int i = 0; i < n_t; ++i)
    if (!pinned[n_o + i]) {
      free.push_back(i);
      u(i) = 0;
    }
  const auto forces_left = [&] {
    Vector<double> left = u;
    multiply_triangle(l_tt, NO_TRANS, m, n_t, left.begin());
    multiply_triangle(l_tt, TRANS, m, n_t, left.begin());
    left.sadd(-1, remaining);
    return left;
  };
  if (!free.empty()) {
    const unsigned int n = free.size();
    FullMatrix<double> rows(n, n_t), block(n);
    for (unsigned int k = 0; k < n; ++k)
      std::copy_n(&factor(n_o + free[k], n_o), free[k] + 1, &rows(k, 0));
    rows.mTmult(block, rows);
    LAPACKFullMatrix<double> cholesky(n);
    cholesky = block;
    cholesky.set_property(LAPACKSupport::symmetric);
    cholesky.compute_cholesky_factorization();
    const Vector<double> left = forces_left();
    Vector<double> solution(n);
    for (unsigned int k = 0; k < n; ++k)
      solution(k) = left(free[k]) - force(n_o + free[k]);
    cholesky.solve(solution);
    for (unsigned int k = 0; k < n; ++k)
      u(free[k]) = displacement(n_o + free[k]) = solution(k);
  }
  const Vector<double> left = forces_left();
  for (unsigned int i = 0; i < n_t; ++i)
    if (pinned[n_o + i])
      force(n_o + i) = left(i);

  Teuchos::BLAS<int, double>().GEMV(NO_TRANS, n_o, n_t, -1., l_to, m, u.begin(), 1, 1., y.begin(),
                                    1);
  divide_by_triangle(l_oo, NO_TRANS, m, n_o, y.begin());
  std::copy(y.begin(), y.end(), displacement.begin());
  return free.size();
}

Vector<double> DenseSchur::solve(Vector<double> force) const {
  const int m = factor.m();
  divide_by_triangle(&factor(0, 0), TRANS, m, m, force.begin());
  divide_by_triangle(&factor(0, 0), NO_TRANS, m, m, force.begin());
  return force;
}

Vector<double> DenseSchur::multiply(Vector<double> y) const {
  multiply_triangle(&factor(0, 0), TRANS, factor.m(), factor.m(), y.begin());
  return y;
}

Vector<double> DenseSchur::transposed_multiply(Vector<double> u) const {
  multiply_triangle(&factor(0, 0), NO_TRANS, factor.m(), factor.m(), u.begin());
  return u;
}

} // namespace rollwave
