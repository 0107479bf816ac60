#include "rollwave/mesh/assembly.h"

#include "rollwave/mesh/graded_quadrature.h"
#include "rollwave/mesh/interval_map.h"
#include "rollwave/mesh/lexicographic_dofs.h"
#include "rollwave/mesh/tensor_elements.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/quadrature_lib.h>

namespace rollwave {

using namespace dealii;

namespace {

/// int r d_r phi_i d_r phi_j dr and int r alpha phi_i phi_j dr over a radial interval.
ShapeProducts integrate_products(const Scene& scene,
                                 const std::vector<Polynomials::Polynomial<double>>& shapes,
                                 double begin, double end) {
  const unsigned int n = shapes.size();
  // Beside a polynomial of degree 2 n there is the factor 1/r: on pieces with the ratio 2 twelve
  // points more leave nothing but round-off.
  const RadialRule rule = graded_rule(begin, end, QGauss<1>(n + 12));
  const double height = end - begin;
  ShapeProducts products = {FullMatrix<double>(n), FullMatrix<double>(n)};
  std::vector<std::vector<double>> shape(n, std::vector<double>(2)); // value and derivative
  for (unsigned int q = 0; q < rule.r.size(); ++q) {
    const double r = rule.r[q];
    const double radial = r * rule.weight[q];       // r dr
    const double angular = scene.alpha(r) * radial; // alpha r dr
    for (unsigned int i = 0; i < n; ++i)
      shapes[i].value((r - begin) / height, shape[i]);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j) {
        products.stiffness(i, j) += radial * ((shape[i][1] / height) * (shape[j][1] / height));
        products.mass(i, j) += angular * (shape[i][0] * shape[j][0]);
      }
  }
  return products;
}

} // namespace

void add_cell_matrices(const RingSpace& space, const RadialProducts& radial,
                       const AddCellMatrix& add) {
  const auto& element = space.dof_handler().get_fe();
  const ShapeProducts reference = reference_products(element.degree);
  FullMatrix<double> cell_matrix(element.n_dofs_per_cell());
  LexicographicDofs dofs(space.dof_handler());
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    tensor_matrix(radial(low[0], high[0]), reference, high[1] - low[1], cell_matrix);
    add(dofs.of(cell), cell_matrix);
  }
}

RadialProducts stiffness_products(const RingSpace& space, const Scene& scene) {
  return [known = IntervalMap<ShapeProducts>(), scene,
          shapes = lobatto_lagrange(space.dof_handler().get_fe().degree)](
             double begin, double end) mutable -> const ShapeProducts& {
    return known.at(begin, end, [&] { return integrate_products(scene, shapes, begin, end); });
  };
}

} // namespace rollwave
