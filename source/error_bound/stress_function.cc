#include "rollwave/error_bound/stress_function.h"

#include "rollwave/base/work.h"
#include "rollwave/error_bound/radial_shapes.h"
#include "rollwave/error_bound/stress_function_constraints.h"
#include "rollwave/mesh/lexicographic_dofs.h"
#include "rollwave/mesh/tensor_elements.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/quadrature_lib.h>

#include <array>
#include <map>

namespace rollwave {

using namespace dealii;

namespace {

/// psi on r = b at the nodes of all edges: the primitive of b lambda, zero where the seam begins.
std::vector<std::vector<double>> surface_potential(const RingSpace& space,
                                                   const std::vector<EdgePressure>& pressures,
                                                   double& growth) {
  const unsigned int degree = space.dof_handler().get_fe().degree;
  const QGaussLobatto<1> nodes(degree + 1);
  std::vector<std::vector<double>> values;
  double begin_value = 0;
  for (unsigned int i = 0; i < pressures.size(); ++i) {
    const SurfaceFace& face = space.surface_faces()[i];
    const double area = space.outer_radius() * (face.end - face.begin);
    values.emplace_back();
    for (unsigned int k = 0; k <= degree; ++k) {
      const double t = nodes.point(k)[0];
      values.back().push_back(begin_value +
                              area * t * (pressures[i].mean - pressures[i].slope * (1 - t) / 2));
    }
    begin_value += area * pressures[i].mean;
  }
  growth = begin_value;
  return values;
}

} // namespace

AffineConstraints<double> stress_function_constraints(const RingSpace& space, const Scene& scene,
                                                      const std::vector<EdgePressure>& pressures) {
  double growth = 0;
  const auto surface_values = surface_potential(space, pressures, growth);
  AffineConstraints<double> constraints(space.relevant_dofs());
  for (const auto& cell : space.outer_cells()) {
    const auto edge = space.surface_face(cell);
    if (!edge)
      continue;
    // Not SurfaceFace::nodes, in which both sides of the seam are one.
    const auto dofs = dofs_on_edge(cell->face(1), space.dof_handler().get_fe().degree);
    for (unsigned int k = 0; k < dofs.size(); ++k)
      if (!constraints.is_constrained(dofs[k])) {
        constraints.add_line(dofs[k]);
        constraints.set_inhomogeneity(dofs[k], surface_values[*edge][k]);
      }
  }
  // The mesh has many hanging nodes, but they lie at few places.
  std::map<std::array<double, 3>, std::vector<double>> known;
  const auto shape_values = [&](double r, double begin, double end) {
    const auto [entry, is_new] = known.try_emplace({{r, begin, end}});
    if (is_new)
      entry->second =
          StressFunctionBasis(scene, space.dof_handler().get_fe().degree, begin, end).values(r);
    return entry->second;
  };
  tie_edges(space, shape_values, growth, constraints);
  constraints.close();
  return constraints;
}

StressFunction::StressFunction(const RingSpace& space, const Scene& scene, SolverKind kind,
                               RadialShapesOfMesh& shapes, Work& work)
    : space(space), reference(reference_products(space.dof_handler().get_fe().degree)),
      solver(make_spd_solver(kind, space)) {
  const std::vector<EdgePressure> no_pressures(space.surface_faces().size());
  solver->set_matrix(
      scene, stress_function_constraints(space, scene, no_pressures),
      [&](double begin, double end) -> const ShapeProducts& {
        return shapes.on(begin, end).products;
      },
      work);
}

FieldVector StressFunction::solve(RadialShapesOfMesh& shapes,
                                  const AffineConstraints<double>& constraints,
                                  const ForceIntegral* force, Work& work) {
  FieldVector lift = space.make_field(), load = space.make_field();
  constraints.distribute(lift);
  lift.update_ghost_values();
  add_load_of(lift, shapes, constraints, load);
  if (force)
    add_load_of(*force, shapes, constraints, load);
  load.compress(VectorOperation::add);
  FieldVector potential = solver->solve(load, work);
  constraints.distribute(potential);
  potential.update_ghost_values();
  return potential;
}

void StressFunction::add_load_of(const FieldVector& lift, RadialShapesOfMesh& shapes,
                                 const AffineConstraints<double>& constraints,
                                 FieldVector& load) const {
  const unsigned int n = space.dof_handler().get_fe().n_dofs_per_cell();
  FullMatrix<double> cell_matrix(n);
  LexicographicDofs dofs(space.dof_handler());
  Vector<double> cell_vector(n), cell_lift(n);
  const auto add_cell = [&](const DoFHandler<2>::active_cell_iterator& cell) {
    if (!cell->is_locally_owned())
      return;
    const auto& of_cell = dofs.of(cell);
    for (unsigned int i = 0; i < n; ++i)
      cell_lift(i) = lift(of_cell[i]);
    if (cell_lift.all_zero())
      return;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    tensor_matrix(shapes.on(low[0], high[0]).products, reference, high[1] - low[1], cell_matrix);
    cell_matrix.vmult(cell_vector, cell_lift);
    cell_vector *= -1;
    constraints.distribute_local_to_global(cell_vector, of_cell, load);
  };
  // Without hanging nodes only cells at the surface and the seam feel the values prescribed there.
  if (space.dof_handler().get_triangulation().has_hanging_nodes())
    for (const auto& cell : space.dof_handler().active_cell_iterators())
      add_cell(cell);
  else
    for (const auto& cell : space.outer_cells())
      add_cell(cell);
}

void StressFunction::add_load_of(const ForceIntegral& force, RadialShapesOfMesh& shapes,
                                 const AffineConstraints<double>& constraints,
                                 FieldVector& load) const {
  const unsigned int n = space.dof_handler().get_fe().degree + 1;
  const auto lagrange = lobatto_lagrange(n - 1);
  const QGauss<1>& rule = force.rule();
  FullMatrix<double> slope(rule.size(), n); // d/dz dz = d/dt dt
  std::vector<double> both(2), on_line(n);
  for (unsigned int p = 0; p < rule.size(); ++p)
    for (unsigned int j = 0; j < n; ++j) {
      lagrange[j].value(rule.point(p)[0], both);
      slope(p, j) = rule.weight(p) * both[1];
    }
  LexicographicDofs dofs(space.dof_handler());
  Vector<double> cell_vector(n * n);
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const RadialShapes& radial = shapes.on(cell->vertex(0)[0], cell->vertex(3)[0]);
    cell_vector = 0;
    for (unsigned int p = 0; p < rule.size(); ++p) {
      radial.integrate_over_r(force.on_line(cell->active_cell_index(), p), on_line);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          cell_vector(i + n * j) += slope(p, j) * on_line[i];
    }
    constraints.distribute_local_to_global(cell_vector, dofs.of(cell), load);
  }
}

} // namespace rollwave
