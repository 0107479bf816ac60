#include "rollwave/solver/dense_schur.h"

namespace rollwave {

using namespace dealii;

DenseSchur::DenseSchur(const FullMatrix<double>& lower_triangle)
    : factor(lower_triangle.m()), schur(lower_triangle.m()) {
  factor = lower_triangle;
  factor.mTmult(schur, factor);
  factor.set_property(LAPACKSupport::lower_triangular);
}

bool DenseSchur::solve(const std::vector<bool>& pinned, const Vector<double>& load,
                       Vector<double>& displacement, Vector<double>& force) const {
  AssertDimension(pinned.size(), size());
  std::vector<unsigned int> free;
  for (unsigned int i = 0; i < size(); ++i)
    if (!pinned[i]) {
      free.push_back(i);
      displacement(i) = 0;
    }
  const auto left = [&] { // g - S u
    Vector<double> left(size());
    schur.vmult(left, displacement);
    left.sadd(-1, load);
    return left;
  };
  const Vector<double> of_pinned = left();
  Vector<double> solution(free.size());
  for (unsigned int k = 0; k < free.size(); ++k)
    solution(k) = of_pinned(free[k]) - force(free[k]);
  const bool is_mixed = !free.empty() && free.size() < size();
  if (is_mixed) {
    LAPACKFullMatrix<double> block(free.size());
    for (unsigned int k = 0; k < free.size(); ++k)
      for (unsigned int l = 0; l < free.size(); ++l)
        block(k, l) = schur(free[k], free[l]);
    block.set_property(LAPACKSupport::symmetric);
    block.compute_cholesky_factorization();
    block.solve(solution);
  } else if (!free.empty())
    solution = solve(solution);
  for (unsigned int k = 0; k < free.size(); ++k)
    displacement(free[k]) = solution(k);
  const Vector<double> reactions = left();
  for (unsigned int i = 0; i < size(); ++i)
    if (pinned[i])
      force(i) = reactions(i);
  return is_mixed;
}

Vector<double> DenseSchur::solve(Vector<double> force) const {
  factor.solve(force);
  factor.solve(force, /*transposed=*/true);
  return force;
}

Vector<double> DenseSchur::multiply(const Vector<double>& y) const {
  Vector<double> product(size());
  factor.vmult(product, y);
  return product;
}

Vector<double> DenseSchur::transposed_multiply(const Vector<double>& u) const {
  Vector<double> product(size());
  factor.Tvmult(product, u);
  return product;
}

} // namespace rollwave
