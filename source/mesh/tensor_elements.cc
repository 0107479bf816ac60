#include "rollwave/mesh/tensor_elements.h"

#include <deal.II/base/quadrature_lib.h>

namespace rollwave {

using namespace dealii;

std::vector<Polynomials::Polynomial<double>> lobatto_lagrange(unsigned int degree) {
  return Polynomials::generate_complete_Lagrange_basis(QGaussLobatto<1>(degree + 1).get_points());
}

ShapeProducts reference_products(unsigned int degree) {
  const QGauss<1> gauss(degree + 1);
  const auto shapes = lobatto_lagrange(degree);
  ShapeProducts products = {FullMatrix<double>(degree + 1), FullMatrix<double>(degree + 1)};
  std::vector<double> first(2), second(2);
  for (unsigned int q = 0; q < gauss.size(); ++q)
    for (unsigned int i = 0; i <= degree; ++i)
      for (unsigned int j = 0; j <= degree; ++j) {
        shapes[i].value(gauss.point(q)[0], first);
        shapes[j].value(gauss.point(q)[0], second);
        products.mass(i, j) += first[0] * second[0] * gauss.weight(q);
        products.stiffness(i, j) += first[1] * second[1] * gauss.weight(q);
      }
  return products;
}

void tensor_matrix(const ShapeProducts& radial, const ShapeProducts& reference, double length,
                   FullMatrix<double>& matrix) {
  const unsigned int n = radial.mass.m();
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int l = 0; l < n; ++l) {
      const double mass = reference.mass(j, l) * length;
      const double stiffness = reference.stiffness(j, l) / length;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int k = 0; k < n; ++k)
          matrix(i + n * j, k + n * l) =
              radial.stiffness(i, k) * mass + radial.mass(i, k) * stiffness;
    }
}

} // namespace rollwave
