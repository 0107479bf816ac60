#include "force_contribution.h"

#include "angular_bubbles.h"
#include "interval_map.h"
#include "lexicographic_dofs.h"
#include "missed_moment.h"
#include "potential_kinks.h"

#include <algorithm>
#include <optional>

namespace rollwave {

using namespace dealii;

namespace {

/// Functions of z at the points of a rule on [0, 1], times its weights: d/dz dz = d/dt dt.
struct WeightedShapes {
  WeightedShapes(const std::vector<Polynomials::Polynomial<double>>& lagrange,
                 const Polynomials::Polynomial<double>& bubble_mode, const Quadrature<1>& rule)
      : value(rule.size(), lagrange.size()), slope(value), bubble(rule.size()), mode(rule.size()) {
    const auto beta = bubble_mode.primitive();
    std::vector<double> both(2);
    for (unsigned int p = 0; p < rule.size(); ++p) {
      for (unsigned int j = 0; j < lagrange.size(); ++j) {
        lagrange[j].value(rule.point(p)[0], both);
        value(p, j) = rule.weight(p) * both[0];
        slope(p, j) = rule.weight(p) * both[1];
      }
      beta.value(rule.point(p)[0], both);
      bubble[p] = rule.weight(p) * both[0];
      mode[p] = rule.weight(p) * both[1];
    }
  }

  FullMatrix<double> value, slope;  ///< of the element's shape functions
  std::vector<double> bubble, mode; ///< of the bubbles: beta and P
};

} // namespace

ForceContribution::ForceContribution(const RingSpace& space,
                                     const AffineConstraints<double>& constraints,
                                     RadialShapesOfMesh& shapes, ForceColumns& columns,
                                     const ForceJumps& jumps)
    : to_potential(space.make_field()) {
  const unsigned int degree = space.dof_handler().get_fe().degree, n = degree + 1;
  const auto lagrange = lobatto_lagrange(degree);
  const auto bubble_mode = AngularBubbles::mode(degree);
  std::optional<WeightedShapes> of_gauss;
  IntervalMap<WeightedShapes> of_other_rules;
  MissedMoment moment(shapes);
  to_bubbles.resize(n * space.dof_handler().get_triangulation().n_active_cells());
  LexicographicDofs dofs(space.dof_handler());
  Vector<double> cell_vector(n * n);
  std::vector<double> loads(n), kinked(n), kinked_z(n);
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    const RadialShapes& radial = shapes.on(low[0], high[0]);
    const ForceLines& lines = columns.on(low[1], high[1]);
    const auto make_shapes = [&] { return WeightedShapes(lagrange, bubble_mode, lines.rule); };
    if (lines.has_rule_of_cell() && !of_gauss)
      of_gauss = make_shapes();
    const auto& [value, slope, bubble, mode] =
        lines.has_rule_of_cell() ? *of_gauss : of_other_rules.at(low[1], high[1], make_shapes);
    ForceLoads& force_loads = columns.loads(low[0], high[0], radial);
    double* const to_bubble = &to_bubbles[n * cell->active_cell_index()];
    const auto kinks = kinks_of_cell(jumps, low, high, degree);
    const double length = high[1] - low[1];
    cell_vector = 0;
    for (unsigned int p = 0; p < lines.columns.size(); ++p) {
      force_loads.integrate(lines.columns[p], loads);
      if (kinks) {
        std::fill(kinked.begin(), kinked.end(), 0.);
        std::fill(kinked_z.begin(), kinked_z.end(), 0.);
        kinks->add_to(lines.rule.point(p)[0], kinked.data(), kinked_z.data());
        for (unsigned int i = 0; i < n; ++i) {
          double of_depth = 0;
          for (unsigned int k = 0; k < n; ++k) {
            loads[i] -= radial.products.mass(i, k) * kinked_z[k];
            of_depth += radial.products.stiffness(i, k) * kinked[k];
          }
          to_bubble[i] -= length * length * bubble[p] * of_depth;
          for (unsigned int j = 0; j < n; ++j)
            cell_vector(i + n * j) -= length * value(p, j) * of_depth;
        }
      }
      for (unsigned int i = 0; i < n; ++i) {
        to_bubble[i] += length * mode[p] * loads[i];
        for (unsigned int j = 0; j < n; ++j)
          cell_vector(i + n * j) += slope(p, j) * loads[i];
      }
    }
    constraints.distribute_local_to_global(cell_vector, dofs.of(cell), to_potential);
    moment.add_cell(low, high, lines, radial);
  }
  to_potential.compress(VectorOperation::add);
  missed = moment.bound(space.communicator());
}

} // namespace rollwave
