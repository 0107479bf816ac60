#include "nested_dissection.h"

#include <deal.II/grid/cell_id.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rollwave {

using namespace dealii;

namespace {

/// Numbers of nodes along a side of a box that is left to the minimum degree ordering.
constexpr double nodes_in_last_box = 10;

/// How often an interval is halved at most: cells cannot be smaller.
constexpr int most_halvings = 64;

/// An interval of coarse cells that is halved again and again, first along the lines between coarse
/// cells, then in their middles.
class Bisection {
public:
  explicit Bisection(unsigned int n_cells) : of_line(n_cells + 1, 0), of_cell(n_cells, 0) {
    halve(0, n_cells, 1);
  }

  /// In which halving, the first being 1, the line at @p place comes up; 0 for both ends.
  int halving(double place) const {
    const double cell = std::floor(place);
    if (place == cell)
      return of_line[static_cast<unsigned int>(cell)];
    int count = of_cell[static_cast<unsigned int>(cell)];
    for (double rest = place - cell; rest != std::floor(rest); rest *= 2)
      ++count;
    return count;
  }

private:
  void halve(unsigned int begin, unsigned int end, int next) {
    if (end - begin == 1) {
      of_cell[begin] = next - 1;
      return;
    }
    const unsigned int middle = (begin + end) / 2;
    of_line[middle] = next;
    halve(begin, middle, next + 1);
    halve(middle, end, next + 1);
  }

  std::vector<int> of_line; ///< the halving of a line between coarse cells
  std::vector<int> of_cell; ///< how many halvings leave a single coarse cell
};

/// The place of a cell in units of coarse cells, (radial, angular), exact in binary arithmetic.
struct Place {
  std::array<double, 2> low;
  double size;
};

Place place_of(const DoFHandler<2>::active_cell_iterator& cell, unsigned int n_radial) {
  // Coarse cells are numbered with the radial index running fastest.
  const CellId id = cell->id();
  Place place = {
      {{double(id.get_coarse_cell_id() % n_radial), double(id.get_coarse_cell_id() / n_radial)}},
      1};
  for (const unsigned int child : id.get_child_indices()) {
    place.size /= 2;
    place.low[0] += place.size * (child % 2);
    place.low[1] += place.size * (child / 2);
  }
  return place;
}

/// In which order the ring is halved in the two directions: always across its longer side.
struct Schedule {
  /// Which halving of the ring the k-th one in a direction is.
  std::array<std::array<int, most_halvings + 1>, 2> step;
  std::vector<double> longer_side; ///< of the boxes before each halving of the ring

  Schedule(double radial_side, double angular_side) {
    std::array<double, 2> sides = {{radial_side, angular_side}};
    std::array<int, 2> count = {{0, 0}};
    for (auto& steps : step)
      steps.fill(std::numeric_limits<int>::max());
    for (int number = 0; number < most_halvings; ++number) {
      const unsigned int longer = sides[1] >= sides[0];
      longer_side.push_back(sides[longer]);
      step[longer][++count[longer]] = number;
      sides[longer] /= 2;
    }
  }

  /// How many halvings leave boxes with sides no longer than @p size.
  int n_halvings(double size) const {
    return std::partition_point(longer_side.begin(), longer_side.end(),
                                [size](double side) { return side > size; }) -
           longer_side.begin();
  }
};

} // namespace

std::vector<int> dissect(const RingSpace& space) {
  const auto& handler = space.dof_handler();
  const auto& triangulation = handler.get_triangulation();
  const auto& element = dynamic_cast<const FE_Q<2>&>(handler.get_fe());
  const unsigned int degree = element.degree, n = degree + 1;
  const std::vector<unsigned int> numbering = element.get_poly_space_numbering_inverse();

  unsigned int n_radial = 0;
  const double first_angle = triangulation.begin(0)->vertex(0)[1];
  for (const auto& cell : triangulation.cell_iterators_on_level(0)) {
    if (cell->vertex(0)[1] != first_angle)
      break;
    ++n_radial;
  }
  const unsigned int n_angular = triangulation.n_cells(0) / n_radial;
  const std::array<Bisection, 2> bisections = {{Bisection(n_radial), Bisection(n_angular)}};
  const Schedule schedule(n_radial, n_angular);
  constexpr int seam = -1, none = std::numeric_limits<int>::max();

  std::vector<int> steps(handler.n_dofs(), none);
  std::vector<types::global_dof_index> dofs(element.n_dofs_per_cell());
  for (const auto& cell : handler.active_cell_iterators()) {
    const Place place = place_of(cell, n_radial);
    const int last = schedule.n_halvings(place.size * nodes_in_last_box / degree);
    // Of the nodes of a cell only those on its edges can lie on a line.
    const auto step = [&](unsigned int direction, double line) {
      const int halving = bisections[direction].halving(line);
      if (halving == 0) // hub and surface, which are no lines, and the seam, which is the first
        return direction == 1 ? seam : none;
      const int of_ring = schedule.step[direction][std::min(halving, most_halvings)];
      return of_ring < last ? of_ring : none;
    };
    std::array<std::array<int, 2>, 2> on_edge;
    for (const unsigned int direction : {0, 1})
      on_edge[direction] = {{step(direction, place.low[direction]),
                             step(direction, place.low[direction] + place.size)}};
    cell->get_dof_indices(dofs);
    const auto of_node = [&](unsigned int direction, unsigned int k) {
      return k == 0 ? on_edge[direction][0] : k == degree ? on_edge[direction][1] : none;
    };
    for (unsigned int i = 0; i < dofs.size(); ++i) {
      int& known = steps[dofs[numbering[i]]];
      known = std::min({known, of_node(0, i % n), of_node(1, i / n)});
    }
  }

  // Later halvings come first; group 0 is what lies on no line.
  for (int& entry : steps)
    entry = entry == none ? 0 : most_halvings - entry;
  std::vector<int> rank(most_halvings + 2, 0);
  for (const int entry : steps)
    rank[entry] = 1;
  rank[0] = 0;
  for (unsigned int group = 1, next = 1; group < rank.size(); ++group)
    rank[group] = rank[group] ? next++ : 0;
  for (int& entry : steps)
    entry = rank[entry];
  return steps;
}

} // namespace rollwave
