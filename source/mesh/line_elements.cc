#include "rollwave/mesh/line_elements.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

std::vector<Polynomials::Polynomial<double>> lobatto_lagrange(unsigned int degree) {
  return Polynomials::generate_complete_Lagrange_basis(QGaussLobatto<1>(degree + 1).get_points());
}

ShapesAtPoint::ShapesAtPoint(const std::vector<Polynomials::Polynomial<double>>& polynomials,
                             double t) {
  double both[2];
  for (const auto& polynomial : polynomials) {
    polynomial.value(t, 1, both);
    value.push_back(both[0]);
    derivative.push_back(both[1]);
  }
}

std::vector<double> graded_radii(double begin, double end) {
  const unsigned int n_pieces = std::max(1., std::ceil(std::log2(end / begin) - 1e-12));
  std::vector<double> radii = {begin};
  for (unsigned int piece = 1; piece < n_pieces; ++piece)
    radii.push_back(begin * std::pow(end / begin, double(piece) / n_pieces));
  radii.push_back(end);
  return radii;
}

unsigned int points_for_pole(double begin, double end, unsigned int degree) {
  // With the ratio q of the radii at the ends, 1/r is analytic in the ellipse around them whose
  // half-axes add up to rho = (sqrt(q) + 1)^2 / (q - 1) half lengths. For polynomials of degree 2 p
  // over r, n points err by rho^(2 p - 2 n). Without contact the error bound can equal the error,
  // and fewer points would then put it below.
  const double q = std::min(end / begin, 2.); // longer intervals are cut
  const double rho = std::pow(std::sqrt(q) + 1, 2) / (q - 1);
  return degree + std::max(2., std::ceil(6.5 / std::log10(rho)));
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

Quadrature<1> graded_rule_on_reference(double begin, double end, const Quadrature<1>& points) {
  const RadialRule rule = graded_rule(begin, end, points);
  std::vector<Point<1>> places;
  std::vector<double> weights;
  for (unsigned int q = 0; q < rule.r.size(); ++q) {
    places.emplace_back((rule.r[q] - begin) / (end - begin));
    weights.push_back(rule.weight[q] / (end - begin));
  }
  return {places, weights};
}

} // namespace rollwave
