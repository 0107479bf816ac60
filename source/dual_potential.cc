#include "dual_potential.h"

#include "edge_constraints.h"
#include "lexicographic_dofs.h"
#include "potential_kinks.h"
#include "potential_shapes.h"
#include "scene.h"
#include "shape_products.h"
#include "work.h"

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

AffineConstraints<double> potential_constraints(const RingSpace& space, const Scene& scene,
                                                const std::vector<EdgePressure>& pressures,
                                                const ForceJumps& jumps) {
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
          PotentialShapes(scene, space.dof_handler().get_fe().degree, begin, end).values(r);
    return entry->second;
  };
  const auto kinks = [&](double r, double z, double begin, double end) {
    double value = 0, derivative = 0;
    PotentialKinks(jumps, begin, end, {r}).add_to((z - begin) / (end - begin), &value, &derivative);
    return value;
  };
  tie_edges(space, shape_values, growth, kinks, constraints);
  constraints.close();
  return constraints;
}

DualPotential::DualPotential(const RingSpace& space, SolverKind kind)
    : space(space), reference(reference_products(space.dof_handler().get_fe().degree)),
      solver(make_symmetric_solver(kind, space)) {}

FieldVector DualPotential::solve(RadialShapesOfMesh& shapes,
                                 const AffineConstraints<double>& constraints,
                                 const FieldVector* force_load, Work& work) {
  FieldVector lift = space.make_field();
  constraints.distribute(lift);
  lift.update_ghost_values();
  FieldVector potential = solver->solve(load_of(lift, shapes, constraints), force_load, work);
  constraints.distribute(potential);
  potential.update_ghost_values();
  return potential;
}

bool DualPotential::belongs_to(const Scene& scene) const {
  return angular_velocity == scene.angular_velocity;
}

void DualPotential::turn_to(const Scene& scene, RadialShapesOfMesh& shapes,
                            const AffineConstraints<double>& constraints, Work& work) {
  angular_velocity.reset(); // until the solver is ready
  solver->set_matrix(
      scene, constraints,
      [&](double begin, double end) -> const ShapeProducts& {
        return shapes.on(begin, end).products;
      },
      work);
  angular_velocity = scene.angular_velocity;
}

FieldVector DualPotential::load_of(const FieldVector& lift, RadialShapesOfMesh& shapes,
                                   const AffineConstraints<double>& constraints) const {
  const unsigned int n = space.dof_handler().get_fe().n_dofs_per_cell();
  FullMatrix<double> cell_matrix(n);
  LexicographicDofs dofs(space.dof_handler());
  Vector<double> cell_vector(n), cell_lift(n);
  FieldVector load = space.make_field();
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
  load.compress(VectorOperation::add);
  return load;
}

} // namespace rollwave
