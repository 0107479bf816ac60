#pragma once

#include "rollwave/mesh/ring_space.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/polynomial.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <map>
#include <utility>
#include <vector>

namespace rollwave {

/**
 * The radial shape functions of a stress function psi on the interval [begin, end] of a cell. Their
 * derivatives by the depth s(r) = int_r^b rho alpha drho are polynomials of degree p - 1 in r,
 *
 *     psi(r) = c + int_begin^r rho alpha q(rho) drho,   psi_s = -q,
 *
 * since psi_s stands for the derivative u_z of a displacement that is smooth in r. In s itself psi
 * is smooth only below the critical speed, and polynomials in s would approximate it worse near the
 * surface. Shape function i is 1 at the i-th Gauss-Lobatto point of the interval and 0 at the
 * others. Restricted to a part of the interval, the functions are those of the part.
 */
class StressFunctionBasis {
public:
  /// @param scene must outlive it
  StressFunctionBasis(const Scene& scene, unsigned int degree, double begin, double end);

  /// All p + 1 shape functions at the radius r, by increasing Gauss-Lobatto point, and their d/ds.
  dealii::Vector<double> values(double r) const;
  dealii::Vector<double> depth_derivatives(double r) const;

private:
  dealii::Vector<double> primitives(double r) const;

  const Scene& scene;
  double begin, end;
  double depth;                                               ///< s(begin) - s(end)
  std::vector<dealii::Polynomials::Polynomial<double>> modes; ///< Legendre's, on [0, 1]
  dealii::FullMatrix<double> coefficients; ///< (i, j) of shape i over primitive j
};

/// The integrals of products of two shape functions, or of their derivatives, over one direction of
/// a cell: n x n, n = degree + 1.
struct ShapeProducts {
  dealii::FullMatrix<double> mass;
  dealii::FullMatrix<double> stiffness;
};

/// The values of the shape functions number i at one point.
struct RadialShape {
  double value;      ///< of a displacement: L_i((r - begin)/(end - begin))
  double derivative; ///< d/dr of it
  double psi;        ///< of a stress function
  double psi_s;      ///< d/ds of it
};

/**
 * One-dimensional shape functions on the radial interval [begin, end] of a cell at the points of a
 * quadrature rule, i counting outwards: Lagrange polynomials L_i in r with nodes at Gauss-Lobatto
 * points for displacements, StressFunctionBasis for stress functions.
 */
struct RadialShapes {
  std::vector<double> r;
  std::vector<double> weight;        ///< of the rule for dr
  std::vector<double> weight_over_r; ///< of the rule for dr / r
  std::vector<double> alpha;
  std::vector<RadialShape> shapes; ///< all numbers at the first point, then at the next

  /// Weights for the n points of one piece of the interval. The weighted sum of the values of a
  /// function at them is its coefficient of the Legendre polynomial of degree n - 1, orthonormal on
  /// [0, 1].
  std::vector<double> highest_mode;

  /// Matrices of the stress function's shape functions, by the rule: mass int 1/r dr, stiffness int
  /// d/ds d/ds ds
  ShapeProducts products;

  /// int w X_i, X_i one of the functions of each shape, by @p weights, for w at the points.
  void integrate(const double* w, const std::vector<double>& weights, double RadialShape::*function,
                 std::vector<double>& integrals) const;
};

/// The error of a polynomial between the points along r at which it has the values of @p line,
/// squared and integrated over dr / r: the square of the coefficient of the highest Legendre
/// polynomial times the number of points. That is about the mean square of the error where
/// coefficients fall slowly, and more than that where they fall fast.
double missed_between_points(const RadialShapes& radial, const double* line);

/// The shapes of all radial intervals of a mesh, which are few.
class RadialShapesOfMesh {
public:
  /// By Gauss' rules that are exact or, with the factor 1/r, accurate to 1e-13.
  RadialShapesOfMesh(const RingSpace& space, const Scene& scene);

  /// Those of a cell of this process between two radii.
  const RadialShapes& on(double begin, double end) const { return of_interval.at({begin, end}); }

private:
  std::map<std::pair<double, double>, RadialShapes> of_interval;
};

} // namespace rollwave
