#include "rollwave/mesh/nested_dissection.h"

#include "rollwave/mesh/ring_space.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/cell_id.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// The position of a node, (radial, angular) in units of coarse cells: exact in binary arithmetic
/// on mesh lines.
using Place = std::array<double, 2>;

struct Node {
  Place place;
  types::global_dof_index dof;
};

using NodeRange = std::pair<std::vector<Node>::iterator, std::vector<Node>::iterator>;

/// A part of the mesh: lines of coarse cells, or halves, quarters .. of one cell.
struct Box {
  Place low, high;
  bool is_closed; ///< true if both angular ends are the seam

  double middle(unsigned int direction) const {
    const double sum = low[direction] + high[direction];
    return high[direction] - low[direction] > 1 ? std::floor(sum / 2) : sum / 2;
  }

  /// True if a node is on the line that halves the box. The first line across the ring includes the
  /// seam, since one line does not split a ring.
  bool holds_on_line(unsigned int direction, const Node& node) const {
    const double place = node.place[direction];
    return place == middle(direction) ||
           (direction == 1 && is_closed && (place == low[1] || place == high[1]));
  }
};

/// The numbers of nodes on both sides of the line that halves a box, and on it.
struct Split {
  Split(const Box& box, unsigned int direction, const NodeRange& nodes) {
    const double middle = box.middle(direction);
    double lowest = nodes.first->place[direction], highest = lowest;
    for (auto node = nodes.first; node != nodes.second; ++node) {
      const double place = node->place[direction];
      lowest = std::min(lowest, place);
      highest = std::max(highest, place);
      const bool is_on = box.holds_on_line(direction, *node);
      on += is_on;
      below += !is_on && place < middle;
    }
    above = nodes.second - nodes.first - below - on;
    // Two nodes of a hanging edge may be apart by round-off only. No smaller box separates them.
    is_possible = lowest < highest && box.low[direction] < middle && middle < box.high[direction];
    leaves_one_half = is_possible && (below == 0) != (above == 0);
  }

  /// The squared number of nodes on the line, which is the number of entries that it adds to the
  /// factor, divided by the number of pairs of nodes that it separates. If it separates none: 0 if
  /// it only makes the box smaller, otherwise infinity.
  double cost() const {
    if (below > 0 && above > 0 && on > 0)
      return on * on / (below * above);
    return leaves_one_half ? 0 : std::numeric_limits<double>::infinity();
  }

  double below = 0, on = 0, above = 0;
  bool is_possible;     ///< false if the nodes are all at one place
  bool leaves_one_half; ///< true if it is possible and one half is empty
};

/// Puts nodes in the order of elimination.
void dissect(NodeRange nodes, const Box& box) {
  if (nodes.second - nodes.first < 2)
    return;
  const Split radial(box, 0, nodes), angular(box, 1, nodes);
  if (!radial.is_possible && !angular.is_possible)
    return;
  const unsigned int direction = radial.cost() < angular.cost() || !angular.is_possible ? 0 : 1;
  const Split& split = direction == 0 ? radial : angular;
  const double middle = box.middle(direction);
  Box lower_half = box, upper_half = box;
  lower_half.high[direction] = upper_half.low[direction] = middle;
  lower_half.is_closed = upper_half.is_closed = box.is_closed && direction == 0;
  if (split.leaves_one_half) {
    dissect(nodes, split.below > 0 ? lower_half : upper_half);
    return;
  }
  const auto line = std::partition(nodes.first, nodes.second, [&](const Node& node) {
    return !box.holds_on_line(direction, node);
  });
  const auto upper = std::partition(
      nodes.first, line, [&](const Node& node) { return node.place[direction] < middle; });
  std::sort(line, nodes.second,
            [](const Node& one, const Node& other) { return one.place < other.place; });
  dissect({nodes.first, upper}, lower_half);
  dissect({upper, line}, upper_half);
}

/// Coarse cells in one row from hub to surface, which have the first numbers.
unsigned int count_radial(const Triangulation<2>& triangulation) {
  unsigned int count = 0;
  for (const auto& cell : triangulation.cell_iterators_on_level(0))
    count += cell->vertex(0)[1] == triangulation.begin(0)->vertex(0)[1];
  return count;
}

} // namespace

std::vector<types::global_dof_index> dissect(const DoFHandler<2>& handler) {
  const auto& triangulation = handler.get_triangulation();
  const unsigned int degree = handler.get_fe().degree, n = degree + 1,
                     n_radial = count_radial(triangulation);
  const IndexSet relevant = DoFTools::extract_locally_relevant_dofs(handler);
  std::vector<Node> nodes(relevant.n_elements(), {{}, numbers::invalid_dof_index});
  LexicographicDofs dofs(handler);
  for (const auto& cell : handler.active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    Triangulation<2>::cell_iterator coarse = cell;
    while (coarse->level() > 0)
      coarse = coarse->parent();
    Place low = {{double(coarse->index() % n_radial), double(coarse->index() / n_radial)}};
    double size = 1;
    const CellId id = cell->id();
    for (const unsigned int child : id.get_child_indices()) {
      size /= 2;
      low[0] += size * (child % 2);
      low[1] += size * (child / 2);
    }
    const auto& of_cell = dofs.of(cell);
    for (unsigned int i = 0; i < of_cell.size(); ++i)
      nodes[relevant.index_within_set(of_cell[i])] = {
          {{low[0] + size * (i % n) / degree, low[1] + size * (i / n) / degree}}, of_cell[i]};
  }
  // Other cells have the rest.
  nodes.erase(
      std::remove_if(nodes.begin(), nodes.end(),
                     [](const Node& node) { return node.dof == numbers::invalid_dof_index; }),
      nodes.end());
  const double n_angular = triangulation.n_cells(0) / n_radial;
  dissect({nodes.begin(), nodes.end()}, {{{0, 0}}, {{double(n_radial), n_angular}}, true});

  std::vector<types::global_dof_index> order;
  for (const Node& node : nodes)
    order.push_back(node.dof);
  return order;
}

} // namespace rollwave
