#ifndef ROLLWAVE_MESH_TENSOR_ELEMENTS_H
#define ROLLWAVE_MESH_TENSOR_ELEMENTS_H

#include <deal.II/base/polynomial.h>
#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace rollwave {

/// Lagrange polynomials on [0, 1] with nodes at the Gauss-Lobatto points, as the elements have.
std::vector<dealii::Polynomials::Polynomial<double>> lobatto_lagrange(unsigned int degree);

/// The integrals of products of two shape functions, or of their derivatives, over one direction of
/// a cell: n x n, n = degree + 1.
struct ShapeProducts {
  dealii::FullMatrix<double> mass;
  dealii::FullMatrix<double> stiffness;
};

/// Those of lobatto_lagrange() over [0, 1].
ShapeProducts reference_products(unsigned int degree);

/**
 * The matrix of a cell whose shape functions are products, number i + n j that of the radial
 * function i and the angular function j:
 *
 *     M_(i + n j)(k + n l) = stiffness_ik mass_jl length + mass_ik stiffness_jl / length,
 *
 * with the @p radial integrals first and those of the @p reference interval second.
 */
void tensor_matrix(const ShapeProducts& radial, const ShapeProducts& reference, double length,
                   dealii::FullMatrix<double>& matrix);

} // namespace rollwave

#endif
