#include "rollwave/error_bound/force_integral.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/error_bound/force_scan.h"
#include "rollwave/mesh/line_elements.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/mpi.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

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

/// What G_h misses between the points along r, squared and integrated over dr / r: the square of
/// the coefficient of the highest Legendre polynomial times the number of points. That is about the
/// mean square of what is missing where coefficients fall slowly, and more than that where they
/// fall fast.
double missed_between_points(const RadialShapes& radial, const double* line) {
  const auto& highest = radial.highest_mode;
  double sum = 0;
  for (unsigned int piece = 0; piece < radial.r.size(); piece += highest.size()) {
    double measure = 0, coefficient = 0;
    for (unsigned int q = 0; q < highest.size(); ++q) {
      measure += radial.weight_over_r[piece + q];
      coefficient += highest[q] * line[piece + q];
    }
    sum += measure * highest.size() * coefficient * coefficient;
  }
  return sum;
}

} // namespace

ForceIntegral::ForceIntegral(const RingSpace& space, const Scene& scene, RadialShapesOfMesh& shapes)
    : uniform(scene.uniform_force.has_value()),
      angular(space.dof_handler().get_fe().degree + (uniform ? 2 : 3)),
      lagrange(Polynomials::generate_complete_Lagrange_basis(angular.get_points())),
      values(space.dof_handler().get_triangulation().n_active_cells()) {
  if (uniform)
    take_uniform(space, *scene.uniform_force, shapes);
  else
    take_expression(space, scene, shapes);
}

void ForceIntegral::take_uniform(const RingSpace& space, double f, RadialShapesOfMesh& shapes) {
  const double b = space.outer_radius();
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    for (const double r : shapes.on(cell->vertex(0)[0], cell->vertex(3)[0]).r)
      values[cell->active_cell_index()].push_back(f * (b - r) * (b + r) / 2);
  }
}

void ForceIntegral::take_expression(const RingSpace& space, const Scene& scene,
                                    RadialShapesOfMesh& shapes) {
  using Cell = DoFHandler<2>::active_cell_iterator;
  std::map<std::pair<double, double>, std::vector<Cell>> sectors; // by intervals of z
  Point<2> largest_cell;
  for (const auto& cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned()) {
      sectors[{cell->vertex(0)[1], cell->vertex(3)[1]}].push_back(cell);
      for (const unsigned int d : {0U, 1U})
        largest_cell[d] = std::max(largest_cell[d], cell->vertex(3)[d] - cell->vertex(0)[d]);
    }
  const std::vector<double> all_ends = all_radii(space);
  ForceScan scan(scene, angular);
  errors_squared.resize(values.size());
  double sum = 0;
  for (const auto& [interval, cells] : sectors) {
    double innermost = scene.outer_radius;
    std::vector<double> radii;
    for (const Cell& cell : cells) {
      const RadialShapes& radial = shapes.on(cell->vertex(0)[0], cell->vertex(3)[0]);
      radii.insert(radii.end(), radial.r.begin(), radial.r.end());
      innermost = std::min(innermost, cell->vertex(0)[0]);
    }
    const double length = interval.second - interval.first;
    const ForceScan::Sector sector =
        scan.sector({std::lower_bound(all_ends.begin(), all_ends.end(), innermost), all_ends.end()},
                    radii, interval.first, length);
    std::size_t place = 0; // of a cell's first radius
    for (const Cell& cell : cells) {
      const RadialShapes& radial = shapes.on(cell->vertex(0)[0], cell->vertex(3)[0]);
      const unsigned int index = cell->active_cell_index(), n_r = radial.r.size();
      double& square = errors_squared[index];
      for (unsigned int p = 0; p < angular.size(); ++p) {
        const double* const line = &sector.lines[p][place];
        values[index].insert(values[index].end(), line, line + n_r);
        square += length * angular.weight(p) * missed_between_points(radial, line);
      }
      for (unsigned int q = 0; q < n_r; ++q)
        square += length * radial.weight_over_r[q] * std::pow(sector.missed[place + q], 2);
      sum += square;
      place += n_r;
    }
  }
  conclude(space, scan, sum, largest_cell);
}

/// Makes delta and the width of the scan from what this and the other processes have seen.
void ForceIntegral::conclude(const RingSpace& space, const ForceScan& scan, double sum,
                             Point<2> largest_cell) {
  const std::string refusal = first_text(space.communicator(), scan.refusal());
  if (!refusal.empty())
    throw BadValue("Cylinder", "Radial force", refusal);
  const auto largest_of_all = [&](double value) {
    return Utilities::MPI::max(value, space.communicator());
  };
  for (const unsigned int d : {0U, 1U})
    largest_cell[d] = largest_of_all(largest_cell[d]) * ForceScan::widest_gap;
  width = std::max(largest_cell[0], space.outer_radius() * largest_cell[1]);
  const bool sees_pole =
      scan.largest() == largest_of_all(scan.largest()) && scan.has_pole(largest_cell);
  delta = largest_of_all(sees_pole) > 0 ? std::numeric_limits<double>::infinity()
                                        : std::sqrt(Utilities::MPI::sum(sum, space.communicator()));
}

void ForceIntegral::on_line_at(unsigned int cell, double t, std::vector<double>& line) const {
  line.assign(n_radii(cell), 0.);
  for (unsigned int p = 0; p < angular.size(); ++p) {
    const double share = lagrange[p].value(t), *const values_on_line = on_line(cell, p);
    for (unsigned int q = 0; q < line.size(); ++q)
      line[q] += share * values_on_line[q];
  }
}

void ForceIntegral::add_load(const RingSpace& space, RadialShapesOfMesh& shapes, TestSpace kind,
                             const AffineConstraints<double>& constraints,
                             FieldVector& load) const {
  const bool of_potential = kind == TestSpace::potentials;
  const unsigned int n = space.dof_handler().get_fe().degree + 1;
  const auto lagrange_shapes = lobatto_lagrange(n - 1);
  FullMatrix<double> along_z(angular.size(), n);
  std::vector<double> both(2), along_r(n);
  for (unsigned int p = 0; p < angular.size(); ++p)
    for (unsigned int j = 0; j < n; ++j) {
      lagrange_shapes[j].value(angular.point(p)[0], both);
      along_z(p, j) = angular.weight(p) * both[of_potential];
    }
  LexicographicDofs dofs(space.dof_handler());
  Vector<double> cell_load(n * n);
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    const RadialShapes& radial = shapes.on(low[0], high[0]);
    const double factor = of_potential ? 1 : high[1] - low[1]; // d/dz dz = d/dt dt
    cell_load = 0;
    for (unsigned int p = 0; p < angular.size(); ++p) {
      const double* const line = on_line(cell->active_cell_index(), p);
      if (of_potential)
        radial.integrate(line, radial.weight_over_r, &RadialShape::potential, along_r);
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
                          RadialShapesOfMesh& shapes) {
  FieldVector load = space.make_field();
  force.add_load(space, shapes, ForceIntegral::TestSpace::displacements, space.constraints(), load);
  load.compress(VectorOperation::add);
  return load;
}

} // namespace rollwave
