#include "rollwave/solver/assembly.h"

#include "rollwave/mesh/line_elements.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

using Cell = DoFHandler<2>::active_cell_iterator;

/// Gauss' rules on cells: with degree + 1 points along z, which are exact, and along r as many as
/// the factor 1/r needs, which depends on the ratio of the cell's radii.
class RulesOfCells {
public:
  explicit RulesOfCells(const RingSpace& space) : space(space) {}

  const FEValues<2>& reinit(const Cell& cell) {
    const double begin = cell->vertex(0)[0], end = cell->vertex(3)[0];
    const auto& element = space.dof_handler().get_fe();
    const unsigned int n_points = points_for_pole(begin, end, element.degree);
    // One rule for all short cells with this number of points, and one for each long interval.
    const auto key = std::pair(n_points, std::max(2., end / begin));
    if (values.count(key) == 0) {
      const Quadrature<1> along_r = graded_rule_on_reference(begin, end, QGauss<1>(n_points));
      values.try_emplace(key, space.mapping(), element,
                         QAnisotropic<2>(along_r, QGauss<1>(element.degree + 1)),
                         update_gradients | update_quadrature_points | update_JxW_values);
    }
    values.at(key).reinit(cell);
    return values.at(key);
  }

private:
  const RingSpace& space;
  std::map<std::pair<unsigned int, double>, FEValues<2>> values;
};

/// @p length to twelve digits: the same for lengths that differ by round-off.
double without_round_off(double length) {
  constexpr int bits = 40;
  int exponent = 0;
  const double mantissa = std::frexp(length, &exponent);
  return std::ldexp(std::round(std::ldexp(mantissa, bits)), exponent - bits);
}

/// a(phi_j, phi_i) on one cell.
FullMatrix<double> stiffness_of_cell(const FEValues<2>& values, const Scene& scene) {
  const unsigned int n = values.dofs_per_cell;
  FullMatrix<double> matrix(n);
  for (const unsigned int q : values.quadrature_point_indices()) {
    const double r = values.quadrature_point(q)[0], alpha = scene.alpha(r);
    for (unsigned int i = 0; i < n; ++i) {
      const Tensor<1, 2>& phi = values.shape_grad(i, q);
      Tensor<1, 2> flux; // r (d_r phi_i, alpha d_z phi_i) dr dz
      flux[0] = r * phi[0] * values.JxW(q);
      flux[1] = r * alpha * phi[1] * values.JxW(q);
      for (unsigned int j = 0; j <= i; ++j)
        matrix(i, j) += flux * values.shape_grad(j, q);
    }
  }
  for (unsigned int i = 0; i < n; ++i) // it is symmetric
    for (unsigned int j = i + 1; j < n; ++j)
      matrix(i, j) = matrix(j, i);
  return matrix;
}

} // namespace

SystemMatrix assemble_stiffness(const RingSpace& space, const Scene& scene,
                                const std::vector<SurfaceNode>& contact_nodes) {
  SystemMatrix matrix(space, space.constraints(), contact_nodes);
  RulesOfCells rules(space);
  // Cells of one radial interval and one length along z have the same matrix, made once.
  std::map<std::tuple<double, double, double>, FullMatrix<double>> known;
  constexpr std::size_t most_known = 1000; // 52 MB at degree 8
  std::vector<types::global_dof_index> dofs(space.dof_handler().get_fe().n_dofs_per_cell());
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    if (known.size() > most_known)
      known.clear();
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    const auto [entry, is_new] =
        known.try_emplace({low[0], high[0], without_round_off(high[1] - low[1])});
    if (is_new)
      entry->second = stiffness_of_cell(rules.reinit(cell), scene);
    cell->get_dof_indices(dofs);
    matrix.add(dofs, entry->second);
  }
  return matrix;
}

} // namespace rollwave
