#include "rollwave/mesh/line_elements.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

std::vector<Polynomials::Polynomial<double>> lobatto_lagrange(unsigned int degree) {
  return Polynomials::generate_complete_Lagrange_basis(QGaussLobatto<1>(degree + 1).get_points());
}

std::vector<double> graded_radii(double begin, double end) {
  const unsigned int n_pieces = std::max(1., std::ceil(std::log2(end / begin) - 1e-12));
  std::vector<double> radii = {begin};
  for (unsigned int piece = 1; piece < n_pieces; ++piece)
    radii.push_back(begin * std::pow(end / begin, double(piece) / n_pieces));
  radii.push_back(end);
  return radii;
}

RadialRule graded_rule(double begin, double end, const Quadrature<1>& points) {
  const std::vector<double> radii = graded_radii(begin, end);
  RadialRule rule;
  for (unsigned int piece = 0; piece + 1 < radii.size(); ++piece)
    for (unsigned int q = 0; q < points.size(); ++q) {
      const double length = radii[piece + 1] - radii[piece];
      rule.r.push_back(radii[piece] + length * points.point(q)[0]);
      rule.weight.push_back(length * points.weight(q));
    }
  return rule;
}

} // namespace rollwave
