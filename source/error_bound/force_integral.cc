#include "rollwave/error_bound/force_integral.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/error_bound/line_integral.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace rollwave {

using namespace dealii;

QGauss<1> angular_rule(const Scene& scene, unsigned int degree) {
  return QGauss<1>(degree + (scene.has_uneven_force() ? 3 : 1));
}

namespace {

using Interval = std::pair<double, double>;

/// The radii at which cells of all processes begin or end. Intervals of a ratio above 2 are cut
/// like those of graded_rule().
std::vector<double> all_radii(const RingSpace& space) {
  std::set<double> own, all;
  for (const auto& cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned()) {
      own.insert(cell->vertex(0)[0]);
      own.insert(cell->vertex(3)[0]);
    }
  for (const auto& some : Utilities::MPI::all_gather(space.communicator(),
                                                     std::vector<double>(own.begin(), own.end())))
    all.insert(some.begin(), some.end());
  const std::vector<double> ends(all.begin(), all.end());
  std::vector<double> radii = {ends.front()};
  for (unsigned int k = 1; k < ends.size(); ++k) {
    const double ratio = ends[k] / ends[k - 1];
    const unsigned int n_pieces = std::max(1., std::ceil(std::log2(ratio) - 1e-12));
    for (unsigned int piece = 1; piece < n_pieces; ++piece)
      radii.push_back(ends[k - 1] * std::pow(ratio, double(piece) / n_pieces));
    radii.push_back(ends[k]);
  }
  return radii;
}

/// The square of the coefficient of the highest Legendre polynomial, orthonormal on [0, 1], in the
/// polynomial through some values at the points of a rule, times their number: about the mean
/// square of what is missing where coefficients fall slowly, and more than that where they fall
/// fast.
class HighestMode {
public:
  explicit HighestMode(const QGauss<1>& rule) {
    const Polynomials::Legendre highest(rule.size() - 1);
    for (unsigned int q = 0; q < rule.size(); ++q)
      weights.push_back(rule.weight(q) * highest.value(rule.point(q)[0]));
  }

  double square(const double* values, unsigned int stride) const {
    double coefficient = 0;
    for (unsigned int q = 0; q < weights.size(); ++q)
      coefficient += weights[q] * values[q * stride];
    return weights.size() * coefficient * coefficient;
  }

private:
  std::vector<double> weights;
};

/// The points of a radial interval of cells in terms of both rules on the intervals of the lines.
struct RadialPoints {
  Places places, for_ends;
  unsigned int n_on_piece; ///< points of the Gauss rule on each piece of the interval
};

/// The mean over the angular interval of a cell of int (G - G_h)^2 / r dr, as the points tell.
/// @param integral has the values of G_h on the cell
/// @param ends lines at both ends of the interval
double mean_square_missed(const ForceIntegral& integral, unsigned int cell,
                          const RadialShapes& radial, const RadialPoints& points,
                          const std::vector<Line>& ends) {
  const QGauss<1>& angular = integral.rule();
  const unsigned int n_r = radial.r.size();
  const double* const of_cell = integral.on_line(cell, 0);
  const HighestMode along_z(angular), along_r{QGauss<1>(points.n_on_piece)};
  double mean = 0;
  for (unsigned int q = 0; q < n_r; ++q)
    mean += radial.weight_over_r[q] * along_z.square(of_cell + q, n_r);
  for (unsigned int piece = 0; piece < n_r; piece += points.n_on_piece) {
    double measure = 0;
    for (unsigned int q = piece; q < piece + points.n_on_piece; ++q)
      measure += radial.weight_over_r[q];
    for (unsigned int p = 0; p < angular.size(); ++p)
      mean += measure * angular.weight(p) * along_r.square(of_cell + p * n_r + piece, 1);
  }
  std::vector<double> line;
  for (const unsigned int end : {0U, 1U}) {
    integral.on_line_at(cell, end == 0 ? inside : 1 - inside, line);
    for (unsigned int q = 0; q < n_r; ++q) {
      const auto& place = points.for_ends[q];
      const double missed = std::abs(ends[end].at(place) - line[q]) + ends[end].doubt_at(place);
      mean += radial.weight_over_r[q] * missed * missed;
    }
  }
  return mean;
}

} // namespace

ForceIntegral::ForceIntegral(const RingSpace& space, const Scene& scene, RadialShapesOfMesh& shapes)
    : is_number(scene.uniform_force.has_value()),
      angular(angular_rule(scene, space.dof_handler().get_fe().degree)),
      lagrange(Polynomials::generate_complete_Lagrange_basis(angular.get_points())),
      first(space.dof_handler().get_triangulation().n_active_cells()), n_radii(first.size()) {
  if (is_number)
    integrate_number(space, scene, shapes);
  else
    integrate_expression(space, scene, shapes);
}

void ForceIntegral::on_line_at(unsigned int cell, double t, std::vector<double>& line) const {
  line.assign(n_radii[cell], 0.);
  for (unsigned int p = 0; p < angular.size(); ++p) {
    const double share = lagrange[p].value(t), *const values_on_line = on_line(cell, p);
    for (unsigned int q = 0; q < line.size(); ++q)
      line[q] += share * values_on_line[q];
  }
}

void ForceIntegral::integrate_number(const RingSpace& space, const Scene& scene,
                                     RadialShapesOfMesh& shapes) {
  std::map<Interval, std::size_t> known;
  const double f = *scene.uniform_force, b = scene.outer_radius;
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    const std::vector<double>& radii = shapes.on(low[0], high[0]).r;
    const auto [entry, is_new] = known.emplace(Interval(low[0], high[0]), values.size());
    if (is_new)
      for (const double r : radii)
        values.push_back(f * (b - r) * (b + r) / 2);
    first[cell->active_cell_index()] = entry->second;
    n_radii[cell->active_cell_index()] = radii.size();
  }
}

void ForceIntegral::integrate_expression(const RingSpace& space, const Scene& scene,
                                         RadialShapesOfMesh& shapes) {
  using Cell = DoFHandler<2>::active_cell_iterator;
  std::map<Interval, std::vector<Cell>> cells_of;
  for (const auto& cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
      cells_of[{cell->vertex(0)[1], cell->vertex(3)[1]}].push_back(cell);

  const std::vector<double> radii = all_radii(space);
  const RadialIntervals intervals(radii, QGauss<1>(angular.size())),
      with_ends(radii, QGaussLobatto<1>(angular.size() + 1));
  IntervalMap<RadialPoints> known_points;
  std::string refusal;
  errors_squared.resize(first.size());
  double sum = 0;
  for (const auto& [interval, cells] : cells_of) {
    const double begin = interval.first, length = interval.second - interval.first;
    double innermost = scene.outer_radius;
    for (const Cell& cell : cells)
      innermost = std::min(innermost, cell->vertex(0)[0]);
    const auto line_at = [&](const RadialIntervals& along_r, double t) {
      const double z = std::fmod(begin + t * length, 2 * numbers::PI);
      return Line(along_r, innermost, [&](double r) {
        const double f = scene.force(r, z);
        if (!std::isfinite(f) && refusal.empty())
          refusal = force_not_finite_at(scene, r, z);
        return std::isfinite(f) ? r * f : 0;
      });
    };
    std::vector<Line> lines;
    for (const Point<1>& point : angular.get_points())
      lines.push_back(line_at(intervals, point[0]));
    const std::vector<Line> ends = {line_at(with_ends, inside), line_at(with_ends, 1 - inside)};
    for (const Cell& cell : cells) {
      const Point<2> low = cell->vertex(0), high = cell->vertex(3);
      const RadialShapes& radial = shapes.on(low[0], high[0]);
      const RadialPoints& points = known_points.at(low[0], high[0], [&] {
        return RadialPoints{intervals.places(radial.r), with_ends.places(radial.r),
                            shapes.gauss(low[0], high[0]).size()};
      });
      const unsigned int n_r = radial.r.size(), number = cell->active_cell_index();
      first[number] = values.size();
      n_radii[number] = n_r;
      for (const Line& on_line : lines)
        for (const auto& place : points.places)
          values.push_back(on_line.at(place));

      errors_squared[number] = length * mean_square_missed(*this, number, radial, points, ends);
      sum += errors_squared[number];
    }
  }
  refusal = first_text(space.communicator(), refusal);
  if (!refusal.empty())
    throw BadValue("Cylinder", "Radial force", refusal);
  delta = std::sqrt(Utilities::MPI::sum(sum, space.communicator()));
}

} // namespace rollwave
