#include "rollwave/error_bound/stress_function.h"

#include "rollwave/base/work.h"
#include "rollwave/error_bound/stress_function_constraints.h"
#include "rollwave/mesh/lexicographic_dofs.h"
#include "rollwave/mesh/tensor_elements.h"
#include "rollwave/scene/scene.h"

#include <algorithm>

namespace rollwave {

using namespace dealii;

StressFunction::StressFunction(const RingSpace& space, const Scene& scene, SolverKind kind,
                               Work& work)
    : space(space), speed(scene.angular_velocity),
      radial(scene, space.dof_handler().get_fe().degree), solver(make_spd_solver(kind, space)) {
  const std::vector<EdgePressure> no_pressures(space.surface_faces().size());
  solver->set_matrix(
      scene, stress_function_constraints(space, scene, no_pressures),
      [&](double begin, double end) -> const ShapeProducts& {
        return radial.on(begin, end).products;
      },
      work);
}

FieldVector StressFunction::solve(const Scene& scene, const std::vector<EdgePressure>& pressures,
                                  const ForceIntegral* force, Work& work) {
  const auto constraints = stress_function_constraints(space, scene, pressures);
  const auto& element = space.dof_handler().get_fe();
  const ShapeProducts reference = reference_products(element.degree);
  FullMatrix<double> cell_matrix(element.n_dofs_per_cell());
  const Vector<double> no_load(element.n_dofs_per_cell());
  LexicographicDofs dofs(space.dof_handler());
  FieldVector load = space.make_field();
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const auto& of_cell = dofs.of(cell);
    if (std::none_of(of_cell.begin(), of_cell.end(),
                     [&](auto dof) { return constraints.is_inhomogeneously_constrained(dof); }))
      continue;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    tensor_matrix(radial.on(low[0], high[0]).products, reference, high[1] - low[1], cell_matrix);
    constraints.distribute_local_to_global(no_load, of_cell, load, cell_matrix);
  }
  if (force)
    force->add_load(space, radial, ForceIntegral::LoadKind::potential, constraints, load);
  load.compress(VectorOperation::add);
  FieldVector potential = solver->solve(load, work);
  constraints.distribute(potential);
  potential.update_ghost_values();
  return potential;
}

} // namespace rollwave
