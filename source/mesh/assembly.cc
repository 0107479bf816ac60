#include "rollwave/mesh/assembly.h"

#include "rollwave/mesh/line_elements.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/quadrature_lib.h>

#include <map>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// int w L_i' L_j' dx and int v L_i L_j dx over an interval by a rule, L_i the polynomials on it.
template <typename StiffnessFactor, typename MassFactor>
ShapeProducts integrate_products(const std::vector<Polynomials::Polynomial<double>>& shapes,
                                 double begin, double length, const RadialRule& rule,
                                 const StiffnessFactor& w, const MassFactor& v) {
  const unsigned int n = shapes.size();
  ShapeProducts products = {FullMatrix<double>(n), FullMatrix<double>(n)};
  std::vector<std::vector<double>> shape(n, std::vector<double>(2)); // value and derivative
  for (unsigned int q = 0; q < rule.r.size(); ++q) {
    const double x = rule.r[q], stiffness = w(x) * rule.weight[q], mass = v(x) * rule.weight[q];
    for (unsigned int i = 0; i < n; ++i)
      shapes[i].value((x - begin) / length, shape[i]);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j) {
        products.stiffness(i, j) += stiffness * ((shape[i][1] / length) * (shape[j][1] / length));
        products.mass(i, j) += mass * (shape[i][0] * shape[j][0]);
      }
  }
  return products;
}

/// Over [0, 1].
ShapeProducts reference_products(unsigned int degree) {
  const QGauss<1> gauss(degree + 1);
  RadialRule rule = {{}, gauss.get_weights()};
  for (const Point<1>& point : gauss.get_points())
    rule.r.push_back(point[0]);
  const auto one = [](double) { return 1.; };
  return integrate_products(lobatto_lagrange(degree), 0, 1, rule, one, one);
}

/**
 * The matrix of a cell whose shape functions are products, number i + n j that of the radial
 * function i and the angular function j:
 *
 *     M_(i + n j)(k + n l) = stiffness_ik mass_jl length + mass_ik stiffness_jl / length,
 *
 * with the @p radial integrals first and those of the @p reference interval second.
 */
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
  return [known = std::map<std::pair<double, double>, ShapeProducts>(), scene,
          shapes = lobatto_lagrange(space.dof_handler().get_fe().degree)](
             double begin, double end) mutable -> const ShapeProducts& {
    const auto [place, is_new] = known.try_emplace({begin, end});
    if (is_new)
      // Beside a polynomial of degree 2 n there is the factor 1/r: on pieces with the ratio 2
      // twelve points more leave nothing but round-off.
      place->second = integrate_products(
          shapes, begin, end - begin, graded_rule(begin, end, QGauss<1>(shapes.size() + 12)),
          [](double r) { return r; }, [&](double r) { return scene.alpha(r) * r; });
    return place->second;
  };
}

} // namespace rollwave
