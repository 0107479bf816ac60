#include "force_contribution.h"

#include "angular_bubbles.h"
#include "interval_map.h"
#include "missed_moment.h"

#include <optional>

namespace rollwave {

using namespace dealii;

namespace {

/// Functions of z at the points of a rule on [0, 1], times its weights: d/dz dz = d/dt dt.
struct WeightedShapes {
  WeightedShapes(const std::vector<Polynomials::Polynomial<double>>& lagrange,
                 const Polynomials::Polynomial<double>& bubble_mode, const Quadrature<1>& rule)
      : slope(rule.size(), lagrange.size()), mode(rule.size()) {
    std::vector<double> both(2);
    for (unsigned int p = 0; p < rule.size(); ++p) {
      for (unsigned int j = 0; j < lagrange.size(); ++j) {
        lagrange[j].value(rule.point(p)[0], both);
        slope(p, j) = rule.weight(p) * both[1];
      }
      mode[p] = rule.weight(p) * bubble_mode.value(rule.point(p)[0]);
    }
  }

  FullMatrix<double> slope; ///< of the element's shape functions
  std::vector<double> mode; ///< of the bubbles
};

} // namespace

ForceContribution::ForceContribution(const RingSpace& space,
                                     const AffineConstraints<double>& constraints,
                                     RadialShapesOfMesh& shapes, ForceColumns& columns)
    : to_potential(space.make_field()) {
  const auto& element = dynamic_cast<const FE_Q<2>&>(space.dof_handler().get_fe());
  const std::vector<unsigned int> numbering = element.get_poly_space_numbering_inverse();
  const unsigned int n = element.degree + 1;
  const auto lagrange = lobatto_lagrange(element.degree);
  const auto bubble_mode = AngularBubbles::mode(element.degree);
  std::optional<WeightedShapes> of_gauss;
  IntervalMap<WeightedShapes> of_exact_rules;
  MissedMoment moment(shapes);
  to_bubbles.resize(n * space.dof_handler().get_triangulation().n_active_cells());
  std::vector<types::global_dof_index> dofs(n * n), ordered(n * n);
  Vector<double> cell_vector(n * n);
  std::vector<double> loads(n);
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    const RadialShapes& radial = shapes.on(low[0], high[0]);
    const ForceLines& lines = columns.on(low[1], high[1]);
    const auto make_shapes = [&] { return WeightedShapes(lagrange, bubble_mode, lines.rule); };
    if (!lines.is_exact() && !of_gauss)
      of_gauss = make_shapes();
    const auto& [slope, mode] =
        lines.is_exact() ? of_exact_rules.at(low[1], high[1], make_shapes) : *of_gauss;
    ForceLoads& force_loads = columns.loads(low[0], high[0], radial);
    double* const to_bubble = &to_bubbles[n * cell->active_cell_index()];
    cell_vector = 0;
    for (unsigned int p = 0; p < lines.columns.size(); ++p) {
      force_loads.integrate(lines.columns[p], loads);
      for (unsigned int i = 0; i < n; ++i) {
        to_bubble[i] += (high[1] - low[1]) * mode[p] * loads[i];
        for (unsigned int j = 0; j < n; ++j)
          cell_vector(i + n * j) += slope(p, j) * loads[i];
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
