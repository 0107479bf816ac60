#include "assembly.h"

#include "errors.h"
#include "scene.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <cmath>

namespace rollwave {

using namespace dealii;

void assemble_stiffness(const RingSpace& space, const Scene& scene, const AddCellMatrix& add) {
  const auto& element = space.dof_handler().get_fe();
  const QGauss<2> gauss(element.degree + 1);
  FEValues<2> values(space.mapping(), element, gauss,
                     update_gradients | update_quadrature_points | update_JxW_values);
  FullMatrix<double> cell_matrix(element.n_dofs_per_cell(), element.n_dofs_per_cell());
  std::vector<types::global_dof_index> dofs(element.n_dofs_per_cell());

  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    values.reinit(cell);
    cell_matrix = 0;
    for (const unsigned int q : values.quadrature_point_indices()) {
      const double r = values.quadrature_point(q)[0];
      const double radial = r * values.JxW(q);        // r dr dz
      const double angular = scene.alpha(r) * radial; // alpha r dr dz
      for (const unsigned int i : values.dof_indices()) {
        const Tensor<1, 2> grad_i = values.shape_grad(i, q);
        for (unsigned int j = 0; j <= i; ++j) {
          const Tensor<1, 2> grad_j = values.shape_grad(j, q);
          cell_matrix(i, j) += radial * grad_i[0] * grad_j[0] + angular * grad_i[1] * grad_j[1];
        }
      }
    }
    for (const unsigned int i : values.dof_indices())
      for (unsigned int j = i + 1; j < values.dofs_per_cell; ++j)
        cell_matrix(i, j) = cell_matrix(j, i);
    cell->get_dof_indices(dofs);
    add(dofs, cell_matrix);
  }
}

FieldVector assemble_load(const RingSpace& space, const Scene& scene) {
  const auto& element = space.dof_handler().get_fe();
  const QGauss<2> gauss(element.degree + 1);
  FEValues<2> values(space.mapping(), element, gauss,
                     update_values | update_quadrature_points | update_JxW_values);
  Vector<double> cell_vector(element.n_dofs_per_cell());
  std::vector<types::global_dof_index> dofs(element.n_dofs_per_cell());
  FieldVector load = space.make_field();

  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    values.reinit(cell);
    cell_vector = 0;
    for (const unsigned int q : values.quadrature_point_indices()) {
      const Point<2> point = values.quadrature_point(q);
      const double r = point[0];
      const double z = std::fmod(point[1], 2 * numbers::PI);
      const double f = scene.force(r, z);
      if (!std::isfinite(f))
        throw BadInput("Cylinder/Radial force is not finite at r = " + std::to_string(r) +
                       ", z = " + std::to_string(z));
      for (const unsigned int i : values.dof_indices())
        cell_vector(i) += r * f * values.shape_value(i, q) * values.JxW(q);
    }
    cell->get_dof_indices(dofs);
    space.constraints().distribute_local_to_global(cell_vector, dofs, load);
  }
  return load;
}

} // namespace rollwave
