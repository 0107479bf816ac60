#pragma once

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature.h>

#include <vector>

namespace rollwave {

/// Lagrange polynomials on [0, 1] with nodes at the Gauss-Lobatto points, as the elements have.
std::vector<dealii::Polynomials::Polynomial<double>> lobatto_lagrange(unsigned int degree);

/// The values and the derivatives of polynomials at a point t.
struct ShapesAtPoint {
  std::vector<double> value, derivative;

  ShapesAtPoint(const std::vector<dealii::Polynomials::Polynomial<double>>& polynomials, double t);
};

/// A quadrature rule for dr on a radial interval.
struct RadialRule {
  std::vector<double> r;
  std::vector<double> weight;
};

/// Cuts [begin, end] into pieces with equal ratios of radii, at most 2, for integrands with a pole
/// at r = 0. Returns their ends.
std::vector<double> graded_radii(double begin, double end);

/// The number of Gauss' points on such a piece that integrate 1/r times a polynomial of degree
/// 2 @p degree to 1e-13.
unsigned int points_for_pole(double begin, double end, unsigned int degree);

/// @p points on each of these pieces.
RadialRule graded_rule(double begin, double end, const dealii::Quadrature<1>& points);

/// The same on [0, 1], to which the interval is scaled.
dealii::Quadrature<1> graded_rule_on_reference(double begin, double end,
                                               const dealii::Quadrature<1>& points);

} // namespace rollwave
