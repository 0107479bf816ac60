#include "assembly.h"

#include "errors.h"
#include "interval_map.h"
#include "lexicographic_dofs.h"
#include "processes.h"
#include "radial_rule.h"
#include "scene.h"
#include "shape_products.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <cmath>
#include <functional>

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

namespace {

/// r f at a point of the ring.
using Moment = std::function<double(const Point<2>&)>;

/// Adds int r f phi_i dr dz over a rectangle of a cell.
void add_load(const Moment& moment, const FiniteElement<2>& element, const QGauss<2>& gauss,
              const BoundingBox<2>& cell, const BoundingBox<2>& part, Vector<double>& load) {
  for (unsigned int q = 0; q < gauss.size(); ++q) {
    const Point<2> point = part.unit_to_real(gauss.point(q));
    const double weight = gauss.weight(q) * part.volume() * moment(point);
    for (unsigned int i = 0; i < load.size(); ++i)
      load(i) += weight * element.shape_value(i, cell.real_to_unit(point));
  }
}

} // namespace

Load assemble_load(const RingSpace& space, const Scene& scene) {
  const auto& element = space.dof_handler().get_fe();
  const QGauss<2> gauss(element.degree + 1);
  FEValues<2> values(space.mapping(), element, gauss,
                     update_values | update_quadrature_points | update_JxW_values);
  Vector<double> cell_vector(element.n_dofs_per_cell());
  std::vector<types::global_dof_index> dofs(element.n_dofs_per_cell());
  Load load = {space.make_field(), {}, {}};
  if (!scene.uniform_force)
    load.breaks =
        find_load_breaks(scene, space.dof_handler().get_triangulation().n_global_active_cells(),
                         space.communicator());
  std::string refusal;
  const Moment moment = [&](const Point<2>& point) {
    const double r = point[0], z = std::fmod(point[1], 2 * numbers::PI), f = scene.force(r, z);
    if (!std::isfinite(f) && refusal.empty())
      refusal = force_not_finite_at(scene, r, z);
    return r * f;
  };

  // The load of a cell that is cut: the rule on the whole does not know it.
  const auto replace_where_cut = [&](const BoundingBox<2>& box, Vector<double>& cell_load) {
    const auto radii = load.breaks.radial_ends(box.lower_bound(0), box.upper_bound(0)),
               angles = load.breaks.angular_ends(box.lower_bound(1), box.upper_bound(1));
    if (radii.size() == 2 && angles.size() == 2)
      return;
    cell_load = 0;
    for (unsigned int i = 0; i + 1 < radii.size(); ++i)
      for (unsigned int j = 0; j + 1 < angles.size(); ++j)
        add_load(moment, element, gauss, box,
                 {{{radii[i], angles[j]}, {radii[i + 1], angles[j + 1]}}}, cell_load);
  };

  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    values.reinit(cell);
    cell_vector = 0;
    for (const unsigned int q : values.quadrature_point_indices()) {
      const double moment_here = moment(values.quadrature_point(q));
      if (!scene.uniform_force)
        load.moments.push_back(moment_here);
      for (const unsigned int i : values.dof_indices())
        cell_vector(i) += moment_here * values.shape_value(i, q) * values.JxW(q);
    }
    if (!load.breaks.empty())
      replace_where_cut(cell->bounding_box(), cell_vector);
    cell->get_dof_indices(dofs);
    space.constraints().distribute_local_to_global(cell_vector, dofs, load.vector);
  }
  refusal = first_text(space.communicator(), refusal);
  if (!refusal.empty())
    throw BadInput(refusal);
  load.vector.compress(VectorOperation::add);
  return load;
}

} // namespace rollwave
