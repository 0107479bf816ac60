#include "rollwave/error_bound/force_integral.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/mesh/line_elements.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/mpi.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

using Cell = DoFHandler<2>::active_cell_iterator;
using Shapes = RadialShapesOfMesh;

/// Lines z = const through each cell on which Q is compared with Q_h.
constexpr unsigned int n_lines = 32;

/// Rules along r cut intervals between ends of cells into these parts, the finer ones once more.
constexpr unsigned int n_parts = 4;

/// The radii at which cells of all processes begin or end, or are cut by graded_radii().
std::vector<double> all_radii(const RingSpace& space) {
  std::set<double> own, all;
  for (const auto& cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
      for (const double r : graded_radii(cell->vertex(0)[0], cell->vertex(3)[0]))
        own.insert(r);
  for (const auto& some : Utilities::MPI::all_gather(space.communicator(),
                                                     std::vector<double>(own.begin(), own.end())))
    all.insert(some.begin(), some.end());
  return {all.begin(), all.end()};
}

/// The integrals of w from each of increasing radii to the last one, by a rule on each interval
/// between them.
template <typename Function>
std::vector<double> integrate_inwards(const std::vector<double>& radii, const Quadrature<1>& rule,
                                      const Function& w) {
  std::vector<double> integrals(radii.size());
  for (unsigned int k = radii.size() - 1; k-- > 0;) {
    const double length = radii[k + 1] - radii[k];
    integrals[k] = integrals[k + 1];
    for (unsigned int q = 0; q < rule.size(); ++q)
      integrals[k] += length * rule.weight(q) * w(radii[k] + length * rule.point(q)[0]);
  }
  return integrals;
}

/// The place of a value in an increasing list.
unsigned int place_of(double value, const std::vector<double>& list) {
  return std::lower_bound(list.begin(), list.end(), value) - list.begin();
}

/// The largest step of an increasing list between two of its values.
double widest_step(const std::vector<double>& list, double begin, double end) {
  double widest = 0;
  for (unsigned int k = place_of(begin, list); k < place_of(end, list); ++k)
    widest = std::max(widest, list[k + 1] - list[k]);
  return widest;
}

/// Q between two angles.
struct SectorSamples {
  std::vector<std::vector<double>> lines;     ///< at some radii, on the lines of the rule along z
  std::vector<double> missed_along_r;         ///< of the middle line
  std::vector<double> missed_along_z_squared; ///< mean squares of Q - Q_h, at the ends of cells
};

/// @param gauss rule along r between the radii
/// @param rule along z; @p lagrange are the polynomials of its points
/// @param ends of cells along r, which are among the @p radii
/// @throws BadValue where f is not finite
SectorSamples sample_sector(const Scene& scene, const QGauss<1>& gauss, const Quadrature<1>& rule,
                            const std::vector<Polynomials::Polynomial<double>>& lagrange,
                            const std::vector<double>& ends, const std::vector<double>& radii,
                            double begin, double length) {
  const auto on_line = [&](double t, const std::vector<double>& at, const Quadrature<1>& along_r) {
    const double z = std::fmod(begin + t * length, 2 * numbers::PI);
    return integrate_inwards(at, along_r, [&](double r) {
      const double f = scene.force(r, z);
      if (!std::isfinite(f))
        throw BadValue("Cylinder", "Radial force", force_not_finite_at(scene, r, z));
      return r * f;
    });
  };
  // From one end of cells to the next by the same points on all processes, whatever cells they own.
  const auto from_surface = [&](double t, const Quadrature<1>& along_r) {
    const std::vector<double> at_ends = on_line(t, ends, QIterated<1>(along_r, n_parts));
    std::vector<double> line = on_line(t, radii, along_r);
    for (unsigned int k = 0; k < radii.size(); ++k) {
      const unsigned int next = place_of(radii[k], ends);
      line[k] += at_ends[next] - line[place_of(ends[next], radii)];
    }
    return line;
  };
  const QMidpoint<1> midpoint;
  SectorSamples samples{{}, {}, std::vector<double>(ends.size())};
  std::vector<std::vector<double>> coarse_lines;
  for (const Point<1>& point : rule.get_points()) {
    samples.lines.push_back(from_surface(point[0], gauss));
    coarse_lines.push_back(on_line(point[0], ends, midpoint));
  }
  for (unsigned int i = 0; i < n_lines; ++i) {
    // The lines stay inside of the cell: a jump at its end belongs to the neighbour.
    const double t = std::clamp(i / (n_lines - 1.), 1e-8, 1 - 1e-8);
    std::vector<double> missed = on_line(t, ends, midpoint);
    for (unsigned int k = 0; k < ends.size(); ++k) {
      for (unsigned int p = 0; p < rule.size(); ++p)
        missed[k] -= lagrange[p].value(t) * coarse_lines[p][k];
      samples.missed_along_z_squared[k] += missed[k] * missed[k] / n_lines;
    }
  }
  const unsigned int middle = rule.size() / 2, n = gauss.size();
  // One finer rule may agree by chance where all are off: with a jump on the same side of all
  // points in an interval. Two do not agree at the same jumps.
  samples.missed_along_r.resize(radii.size());
  for (const auto& finer_rule :
       {QIterated<1>(gauss, n_parts), QIterated<1>(QGaussLobatto<1>(n + 1), n_parts)}) {
    const std::vector<double> line = from_surface(rule.point(middle)[0], finer_rule);
    for (unsigned int k = 0; k < radii.size(); ++k)
      samples.missed_along_r[k] += std::abs(line[k] - samples.lines[middle][k]);
  }
  return samples;
}

} // namespace

ForceIntegral::ForceIntegral(const RingSpace& space, const Scene& scene, const Shapes& shapes)
    : uniform(scene.force.uniform.has_value()),
      angular(space.dof_handler().get_fe().degree + (uniform ? 1 : 3)),
      inwards(space.dof_handler().get_fe().degree + 1),
      lagrange(Polynomials::generate_complete_Lagrange_basis(angular.get_points())),
      values(space.dof_handler().get_triangulation().n_active_cells()) {
  if (uniform)
    integrate_uniform(space, *scene.force.uniform, shapes);
  else
    integrate_expression(space, scene, shapes);
}

void ForceIntegral::integrate_uniform(const RingSpace& space, double f, const Shapes& shapes) {
  const double b = space.outer_radius();
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    for (const double r : shapes.on(cell->vertex(0)[0], cell->vertex(3)[0]).r)
      values[cell->active_cell_index()].push_back(f * (b - r) * (b + r) / 2);
  }
}

void ForceIntegral::integrate_expression(const RingSpace& space, const Scene& scene,
                                         const Shapes& shapes) {
  std::map<std::pair<double, double>, std::vector<Cell>> sectors; // by intervals of z
  for (const auto& cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
      sectors[{cell->vertex(0)[1], cell->vertex(3)[1]}].push_back(cell);
  const std::vector<double> mesh_radii = all_radii(space);
  errors_squared.resize(values.size());
  std::string refusal;
  try {
    for (const auto& [interval, cells] : sectors)
      integrate_sector(scene, mesh_radii, cells, shapes);
  } catch (const BadValue& bad) {
    refusal = bad.reason;
  }
  if (refusal = first_text(space.communicator(), refusal); !refusal.empty())
    throw BadValue("Cylinder", "Radial force", refusal);
  const double squared = std::accumulate(errors_squared.begin(), errors_squared.end(), 0.);
  delta = std::sqrt(Utilities::MPI::sum(squared, space.communicator()));
  width = Utilities::MPI::max(width, space.communicator());
}

/// Sets Q_h, delta and the width on the cells between two angles.
void ForceIntegral::integrate_sector(const Scene& scene, const std::vector<double>& mesh_radii,
                                     const std::vector<Cell>& cells, const Shapes& shapes) {
  const double begin = cells.front()->vertex(0)[1], length = cells.front()->vertex(3)[1] - begin;
  double innermost = scene.outer_radius;
  std::vector<double> radii;
  for (const Cell& cell : cells) {
    const RadialShapes& radial = shapes.on(cell->vertex(0)[0], cell->vertex(3)[0]);
    radii.insert(radii.end(), radial.r.begin(), radial.r.end());
    innermost = std::min(innermost, cell->vertex(0)[0]);
  }
  const std::vector<double> ends(std::lower_bound(mesh_radii.begin(), mesh_radii.end(), innermost),
                                 mesh_radii.end());
  radii.insert(radii.end(), ends.begin(), ends.end());
  std::sort(radii.begin(), radii.end());
  const SectorSamples samples =
      sample_sector(scene, inwards, angular, lagrange, ends, radii, begin, length);
  width = std::max(width, scene.outer_radius * length / (n_lines - 1));
  const unsigned int middle = inwards.size() / 2;
  const double widest = (inwards.point(middle)[0] - inwards.point(middle - 1)[0]) / n_parts;
  for (const Cell& cell : cells) {
    const double low = cell->vertex(0)[0], high = cell->vertex(3)[0];
    const RadialShapes& radial = shapes.on(low, high);
    const unsigned int index = cell->active_cell_index(), n_r = radial.r.size();
    // A process has no radii in cells of others.
    width = std::max(width, widest * std::max(widest_step(radii, low, high),
                                              widest_step(ends, low, high) / n_parts));
    double between = 0, along_r = 0;
    for (unsigned int p = 0; p < angular.size(); ++p) {
      for (const double r : radial.r)
        values[index].push_back(samples.lines[p][place_of(r, radii)]);
      between += angular.weight(p) * missed_between_points(radial, &values[index][p * n_r]);
    }
    for (unsigned int q = 0; q < n_r; ++q)
      along_r += radial.weight_over_r[q] *
                 std::pow(samples.missed_along_r[place_of(radial.r[q], radii)], 2);
    const double along_z = std::log(high / low) *
                           (samples.missed_along_z_squared[place_of(low, ends)] +
                            samples.missed_along_z_squared[place_of(high, ends)]) /
                           2;
    errors_squared[index] =
        length * (between + 4 * std::pow(std::sqrt(along_r) + std::sqrt(along_z), 2));
  }
}

void ForceIntegral::values_on_line_at(unsigned int cell, double t,
                                      std::vector<double>& line) const {
  line.assign(n_radii(cell), 0.);
  for (unsigned int p = 0; p < angular.size(); ++p) {
    const double share = lagrange[p].value(t);
    const double* const values_on_line = on_line(cell, p);
    for (unsigned int q = 0; q < line.size(); ++q)
      line[q] += share * values_on_line[q];
  }
}

void ForceIntegral::add_load(const RingSpace& space, const Shapes& shapes, TestSpace kind,
                             const AffineConstraints<double>& constraints,
                             FieldVector& load) const {
  const bool of_psi = kind == TestSpace::stress_functions;
  const unsigned int n = space.dof_handler().get_fe().degree + 1;
  const auto lagrange_shapes = lobatto_lagrange(n - 1);
  FullMatrix<double> along_z(angular.size(), n);
  for (unsigned int p = 0; p < angular.size(); ++p) {
    const ShapesAtPoint shapes_at_p(lagrange_shapes, angular.point(p)[0]);
    for (unsigned int j = 0; j < n; ++j)
      along_z(p, j) = angular.weight(p) * (of_psi ? shapes_at_p.derivative : shapes_at_p.value)[j];
  }
  std::vector<double> along_r(n);
  LexicographicDofs dofs(space.dof_handler());
  Vector<double> cell_load(n * n);
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    const RadialShapes& radial = shapes.on(low[0], high[0]);
    const double factor = of_psi ? 1 : high[1] - low[1]; // d/dz dz = d/dt dt
    cell_load = 0;
    for (unsigned int p = 0; p < angular.size(); ++p) {
      const double* const line = on_line(cell->active_cell_index(), p);
      if (of_psi)
        radial.integrate(line, radial.weight_over_r, &RadialShape::psi, along_r);
      else
        radial.integrate(line, radial.weight, &RadialShape::derivative, along_r);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          cell_load(i + n * j) += factor * along_z(p, j) * along_r[i];
    }
    constraints.distribute_local_to_global(cell_load, dofs.of(cell), load);
  }
}

FieldVector assemble_load(const RingSpace& space, const ForceIntegral& force,
                          const Shapes& shapes) {
  FieldVector load = space.make_field();
  force.add_load(space, shapes, ForceIntegral::TestSpace::displacements, space.constraints(), load);
  load.compress(VectorOperation::add);
  return load;
}

} // namespace rollwave
