#include "rollwave/error_bound/dual_cell_matrix.h"

#include "rollwave/mesh/line_elements.h"

#include <deal.II/base/quadrature_lib.h>

namespace rollwave {

using namespace dealii;

namespace {

/// int L_i L_j dt and int L_i' L_j' dt over [0, 1], L_i the polynomials along z.
ShapeProducts angular_products(unsigned int degree) {
  const auto shapes = lobatto_lagrange(degree);
  const QGauss<1> gauss(degree + 1);
  ShapeProducts products = {FullMatrix<double>(degree + 1), FullMatrix<double>(degree + 1)};
  for (unsigned int q = 0; q < gauss.size(); ++q) {
    const auto [value, derivative] = ShapesAtPoint(shapes, gauss.point(q)[0]);
    for (unsigned int i = 0; i <= degree; ++i)
      for (unsigned int j = 0; j <= degree; ++j) {
        products.mass(i, j) += gauss.weight(q) * value[i] * value[j];
        products.stiffness(i, j) += gauss.weight(q) * derivative[i] * derivative[j];
      }
  }
  return products;
}

/**
 * The matrix of a cell whose shape functions are products, number i + n j that of the radial
 * function i and the angular function j:
 *
 *     M_(i + n j)(k + n l) = stiffness_ik mass_jl length + mass_ik stiffness_jl / length,
 *
 * with the @p radial integrals first and the @p angular ones, on [0, 1], second.
 */
void tensor_matrix(const ShapeProducts& radial, const ShapeProducts& angular, double length,
                   FullMatrix<double>& matrix) {
  const unsigned int n = radial.mass.m();
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int l = 0; l < n; ++l) {
      const double mass = angular.mass(j, l) * length;
      const double stiffness = angular.stiffness(j, l) / length;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int k = 0; k < n; ++k)
          matrix(i + n * j, k + n * l) =
              radial.stiffness(i, k) * mass + radial.mass(i, k) * stiffness;
    }
}

} // namespace

DualCellMatrix::DualCellMatrix(const RadialShapesOfMesh& shapes, unsigned int degree)
    : shapes(shapes), angular(angular_products(degree)), matrix((degree + 1) * (degree + 1)) {}

const FullMatrix<double>& DualCellMatrix::on(const DoFHandler<2>::active_cell_iterator& cell) {
  const Point<2> low = cell->vertex(0), high = cell->vertex(3);
  tensor_matrix(shapes.on(low[0], high[0]).products, angular, high[1] - low[1], matrix);
  return matrix;
}

} // namespace rollwave
