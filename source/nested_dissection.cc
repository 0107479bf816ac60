#include "nested_dissection.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/grid/cell_id.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rollwave {

using namespace dealii;

namespace {

/// Numbers of nodes along a side of a box that is left to the minimum degree ordering.
constexpr double nodes_in_last_box = 10;

/// How often a box is halved at most: cells cannot be smaller.
constexpr int most_halvings = 2 * 64;

/// The place of a cell in units of coarse cells, (radial, angular), exact in binary arithmetic.
struct Place {
  std::array<double, 2> low;
  double size;
};

Place place_of(const CellId& id, unsigned int n_radial) {
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

/// Where a box from @p low to @p high is halved: along a line between coarse cells if it has one.
double middle(double low, double high) {
  return high - low > 1 ? std::floor((low + high) / 2) : (low + high) / 2;
}

int group_of(const std::array<double, 2>& node, double last_size,
             const std::array<double, 2>& n_cells) {
  // The seam is the first line.
  if (node[1] == 0 || node[1] == n_cells[1])
    return most_halvings;
  std::array<double, 2> low = {{0, 0}}, high = n_cells;
  for (int group = most_halvings - 1; group > 0; --group) {
    const unsigned int side = high[1] - low[1] >= high[0] - low[0];
    if (high[side] - low[side] <= last_size)
      break;
    const double line = middle(low[side], high[side]);
    if (node[side] == line)
      return group;
    (node[side] < line ? high : low)[side] = line;
  }
  return 0;
}

} // namespace

std::vector<int> dissect(const RingSpace& space) {
  const auto& handler = space.dof_handler();
  const auto& triangulation = handler.get_triangulation();
  const auto& element = dynamic_cast<const FE_Q<2>&>(handler.get_fe());
  const unsigned int degree = element.degree;
  const std::vector<unsigned int> numbering = element.get_poly_space_numbering_inverse();
  const QGaussLobatto<1> nodes(degree + 1);

  // Coarse cells are numbered with the radial index running fastest.
  unsigned int n_radial = 0;
  const double first_angle = triangulation.begin(0)->vertex(0)[1];
  for (const auto& cell : triangulation.cell_iterators_on_level(0)) {
    if (cell->vertex(0)[1] != first_angle)
      break;
    ++n_radial;
  }
  const std::array<double, 2> n_cells = {
      {double(n_radial), double(triangulation.n_cells(0) / n_radial)}};

  std::vector<int> groups(handler.n_dofs(), -1);
  std::vector<types::global_dof_index> dofs(element.n_dofs_per_cell());
  for (const auto& cell : handler.active_cell_iterators()) {
    const Place place = place_of(cell->id(), n_radial);
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < dofs.size(); ++i) {
      int& group = groups[dofs[numbering[i]]];
      if (group < 0)
        group = group_of({{place.low[0] + place.size * nodes.point(i % (degree + 1))[0],
                           place.low[1] + place.size * nodes.point(i / (degree + 1))[0]}},
                         place.size * nodes_in_last_box / degree, n_cells);
    }
  }
  // Without the groups that have no node
  std::vector<int> rank(most_halvings + 1, 0);
  for (const int group : groups)
    rank[group] = 1;
  rank[0] = 0;
  for (int group = 1, next = 1; group <= most_halvings; ++group)
    rank[group] = rank[group] ? next++ : 0;
  for (int& group : groups)
    group = rank[group];
  return groups;
}

} // namespace rollwave
