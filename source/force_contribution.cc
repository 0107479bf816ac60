#include "force_contribution.h"

#include "angular_bubbles.h"
#include "dual_potential.h"
#include "missed_moment.h"

namespace rollwave {

using namespace dealii;

ForceContribution::ForceContribution(const RingSpace& space, const Scene& scene,
                                     const ForceInterpolant& force, RadialShapesOfMesh& shapes,
                                     ForceColumns& columns, const QGauss<1>& gauss)
    : to_potential(space.make_field()) {
  const auto& element = dynamic_cast<const FE_Q<2>&>(space.dof_handler().get_fe());
  const std::vector<unsigned int> numbering = element.get_poly_space_numbering_inverse();
  const unsigned int n = element.degree + 1;
  FullMatrix<double> weighted_slope(gauss.size(), n); // on [0, 1]: d/dz dz = d/dt dt
  std::vector<double> weighted_mode;
  const auto lagrange = lobatto_lagrange(element.degree);
  const auto mode = AngularBubbles::mode(element.degree);
  std::vector<double> both(2);
  for (unsigned int p = 0; p < gauss.size(); ++p) {
    for (unsigned int j = 0; j < n; ++j) {
      lagrange[j].value(gauss.point(p)[0], both);
      weighted_slope(p, j) = gauss.weight(p) * both[1];
    }
    weighted_mode.push_back(gauss.weight(p) * mode.value(gauss.point(p)[0]));
  }

  const AffineConstraints<double> constraints =
      potential_constraints(space, scene, std::vector<EdgePressure>(space.surface_faces().size()));
  MissedMoment moment(scene, force, shapes, columns, gauss);
  to_bubbles.resize(n * space.dof_handler().get_triangulation().n_active_cells());
  std::vector<types::global_dof_index> dofs(n * n), ordered(n * n);
  Vector<double> cell_vector(n * n);
  std::vector<double> loads(n);
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    const RadialShapes& radial = shapes.on(low[0], high[0]);
    const auto& lines = columns.on(low[1], high[1]);
    ForceLoads& force_loads = columns.loads(low[0], high[0], radial);
    double* const to_bubble = &to_bubbles[n * cell->active_cell_index()];
    cell_vector = 0;
    for (unsigned int p = 0; p < gauss.size(); ++p) {
      force_loads.integrate(lines[p], loads);
      for (unsigned int i = 0; i < n; ++i) {
        to_bubble[i] += (high[1] - low[1]) * weighted_mode[p] * loads[i];
        for (unsigned int j = 0; j < n; ++j)
          cell_vector(i + n * j) += weighted_slope(p, j) * loads[i];
      }
    }
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < dofs.size(); ++i)
      ordered[i] = dofs[numbering[i]];
    constraints.distribute_local_to_global(cell_vector, ordered, to_potential);
    moment.add_cell(low, high, lines, radial);
  }
  to_potential.compress(VectorOperation::add);
  missed = moment.bound(space.communicator());
}

} // namespace rollwave
