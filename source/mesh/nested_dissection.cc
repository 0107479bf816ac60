#include "rollwave/mesh/nested_dissection.h"

#include "rollwave/mesh/cell_places.h"
#include "rollwave/mesh/lexicographic_dofs.h"

#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// A node with its place in units of coarse cells, (radial, angular), exact in binary arithmetic.
struct Node {
  std::array<double, 2> place;
  types::global_dof_index dof;
};

using Range = std::pair<std::vector<Node>::iterator, std::vector<Node>::iterator>;

/// A part of the mesh: lines of coarse cells, or halves, quarters .. of one cell.
struct Box {
  std::array<double, 2> low, high;
  bool is_closed; ///< whether both angular ends are the seam

  double middle(unsigned int direction) const {
    const double sum = low[direction] + high[direction];
    return high[direction] - low[direction] > 1 ? std::floor(sum / 2) : sum / 2;
  }
};

/// A line that halves a box, and the seam with it when an angular line alone would not.
struct Cut {
  Cut(const Box& box, unsigned int direction)
      : direction(direction), middle(box.middle(direction)),
        seam(direction == 1 && box.is_closed ? box.low[1] : middle),
        seam_again(direction == 1 && box.is_closed ? box.high[1] : middle) {}

  bool holds(const Node& node) const {
    const double place = node.place[direction];
    return place == middle || place == seam || place == seam_again;
  }
  bool has_below(const Node& node) const { return node.place[direction] < middle; }

  unsigned int direction;
  double middle, seam, seam_again;
};

/// How well a cut divides nodes: the squared number of those on it, the entries that it adds to the
/// factor, for each pair of nodes that it parts. Nothing when it only takes away an empty half;
/// infinite when it would go on to part no nodes.
double cost(const Cut& cut, const Range& nodes) {
  double below = 0, on = 0, lowest = nodes.first->place[cut.direction], highest = lowest;
  for (auto node = nodes.first; node != nodes.second; ++node) {
    const double place = node->place[cut.direction];
    lowest = std::min(lowest, place);
    highest = std::max(highest, place);
    const bool is_on = cut.holds(*node);
    on += is_on;
    below += !is_on && cut.has_below(*node);
  }
  const double above = nodes.second - nodes.first - below - on;
  if (below > 0 && above > 0 && on > 0)
    return on * on / (below * above);
  const bool takes_nothing = on == 0 && (below == 0 || above == 0);
  return takes_nothing && lowest < highest ? 0 : std::numeric_limits<double>::infinity();
}

/// Puts nodes in the order of elimination.
void dissect(Range nodes, const Box& box) {
  if (nodes.second - nodes.first < 2)
    return;
  const std::array<Cut, 2> cuts = {{Cut(box, 0), Cut(box, 1)}};
  const Cut& cut = cuts[!(cost(cuts[0], nodes) < cost(cuts[1], nodes))];
  const unsigned int direction = cut.direction;

  const auto line =
      std::partition(nodes.first, nodes.second, [&](const Node& node) { return !cut.holds(node); });
  const auto upper =
      std::partition(nodes.first, line, [&](const Node& node) { return cut.has_below(node); });
  std::sort(line, nodes.second,
            [](const Node& one, const Node& other) { return one.place < other.place; });
  Box half = box;
  half.is_closed = box.is_closed && direction == 0;
  half.high[direction] = cut.middle;
  dissect({nodes.first, upper}, half);
  half.low[direction] = cut.middle;
  half.high[direction] = box.high[direction];
  dissect({upper, line}, half);
}

/// Places from 0 to 1 for the nodes 0 to @p degree along a side of a cell, such that halving the
/// interval halves the nodes: exact ones for degree 2.
std::vector<double> node_places(unsigned int degree) {
  std::vector<double> places(degree + 1);
  const auto halve = [&](const auto& self, unsigned int begin, unsigned int end) -> void {
    const unsigned int middle = (begin + end) / 2;
    if (middle == begin)
      return;
    places[middle] = (places[begin] + places[end]) / 2;
    self(self, begin, middle);
    self(self, middle, end);
  };
  places[degree] = 1;
  halve(halve, 0, degree);
  return places;
}

} // namespace

std::vector<types::global_dof_index> dissect(const DoFHandler<2>& handler) {
  const auto& triangulation = handler.get_triangulation();
  const unsigned int degree = handler.get_fe().degree, n = degree + 1;
  const std::vector<double> places = node_places(degree);

  const CellPlaces cells(triangulation);
  std::vector<Node> nodes(handler.n_dofs());
  LexicographicDofs dofs(handler);
  for (const auto& cell : handler.active_cell_iterators()) {
    const CellPlace place = cells.of(cell);
    const auto& of_cell = dofs.of(cell);
    for (unsigned int i = 0; i < of_cell.size(); ++i)
      nodes[of_cell[i]] = {
          {{place.low[0] + place.size * places[i % n], place.low[1] + place.size * places[i / n]}},
          of_cell[i]};
  }
  const Box ring = {{{0, 0}}, {{double(cells.n_radial()), double(cells.n_angular())}}, true};
  dissect({nodes.begin(), nodes.end()}, ring);

  std::vector<types::global_dof_index> order;
  order.reserve(nodes.size());
  for (const Node& node : nodes)
    order.push_back(node.dof);
  return order;
}

} // namespace rollwave
