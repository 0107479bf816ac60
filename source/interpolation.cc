#include "interpolation.h"

#include <deal.II/base/polynomial.h>

namespace rollwave {

using namespace dealii;

FullMatrix<double> interpolation(const Quadrature<1>& from, const Quadrature<1>& to) {
  const auto lagrange = Polynomials::generate_complete_Lagrange_basis(from.get_points());
  FullMatrix<double> matrix(to.size(), from.size());
  for (unsigned int q = 0; q < to.size(); ++q)
    for (unsigned int i = 0; i < from.size(); ++i)
      matrix(q, i) = lagrange[i].value(to.point(q)[0]);
  return matrix;
}

FinerRule::FinerRule(const QGauss<1>& rule, const Quadrature<1>& fine)
    : rule(rule), fine(fine), interpolation(rollwave::interpolation(rule, fine)) {}

} // namespace rollwave
