#include "nested_dissection.h"

#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/cell_id.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// The way of a node through the halvings, two bits for each, the first halving in the highest: 0
/// for the lower half, 1 for the upper one, 2 for the line between them, which comes after both.
/// The order of the numbers is that of elimination. The codes of both directions together, which
/// have their bits at different halvings, are the code of the node.
using Code = std::uint64_t;

constexpr Code upper = 1, between = 2;
constexpr int seam_shift = 62; ///< of the cut at the seam, before all halvings

/// Where the bits of the halvings of each direction are, at first those of its first halving: the
/// part is always halved across its longer side. Parts beyond the last bits are not told apart,
/// which costs a little fill and nothing else.
std::array<std::vector<int>, 2> schedule(std::array<double, 2> sides) {
  std::array<std::vector<int>, 2> shifts;
  for (int shift = seam_shift - 2; shift >= 0; shift -= 2) {
    const unsigned int longer = sides[1] >= sides[0];
    shifts[longer].push_back(shift);
    sides[longer] /= 2;
  }
  return shifts;
}

/// An interval of coarse cells that is halved again and again, first along the lines between coarse
/// cells, then in their middles.
class Bisection {
public:
  /// @param is_closed whether both ends are the seam
  Bisection(unsigned int n_cells, const std::vector<int>& shifts, bool is_closed)
      : shifts(shifts), of_line(n_cells + 1, 0), of_cell(n_cells) {
    halve(0, n_cells, 0, 0);
    for (const int shift : shifts)
      of_line.back() |= upper << shift; // the upper end is always in the upper half
    if (is_closed)
      of_line.front() = of_line.back() = between << seam_shift;
  }

  /// The code of a line, whose @p place is in units of coarse cells.
  Code code(double place) const {
    const auto cell = static_cast<unsigned int>(place);
    double rest = place - cell;
    if (rest == 0)
      return of_line[cell];
    Code code = of_cell[cell].first;
    for (unsigned int k = of_cell[cell].second; k < shifts.size(); ++k) {
      rest *= 2;
      if (rest == 1)
        return code | between << shifts[k];
      if (rest > 1) {
        code |= upper << shifts[k];
        rest -= 1;
      }
    }
    return code;
  }

private:
  /// @param k how many halvings have led to the cells from @p begin to @p end, with their @p code
  void halve(unsigned int begin, unsigned int end, unsigned int k, Code code) {
    if (end - begin == 1 || k == shifts.size()) {
      std::fill(of_cell.begin() + begin, of_cell.begin() + end, std::pair(code, k));
      std::fill(of_line.begin() + begin + 1, of_line.begin() + end, code);
      return;
    }
    const unsigned int middle = (begin + end) / 2;
    of_line[middle] = code | between << shifts[k];
    halve(begin, middle, k + 1, code);
    halve(middle, end, k + 1, code | upper << shifts[k]);
  }

  const std::vector<int>& shifts;
  std::vector<Code> of_line;
  std::vector<std::pair<Code, unsigned int>> of_cell; ///< and how many halvings lead to the cell
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

unsigned int count_radial_cells(const Triangulation<2>& triangulation) {
  const double first_angle = triangulation.begin(0)->vertex(0)[1];
  unsigned int n_radial = 0;
  for (const auto& cell : triangulation.cell_iterators_on_level(0)) {
    if (cell->vertex(0)[1] != first_angle)
      break;
    ++n_radial;
  }
  return n_radial;
}

} // namespace

std::vector<types::global_dof_index> dissect(const DoFHandler<2>& handler) {
  const auto& triangulation = handler.get_triangulation();
  const auto& element = dynamic_cast<const FE_Q<2>&>(handler.get_fe());
  const unsigned int n = element.degree + 1;
  const std::vector<unsigned int> numbering = element.get_poly_space_numbering_inverse();
  const std::vector<double> places = node_places(element.degree);

  const unsigned int n_radial = count_radial_cells(triangulation);
  const unsigned int n_angular = triangulation.n_cells(0) / n_radial;
  const auto shifts = schedule({{double(n_radial), double(n_angular)}});
  const std::array<Bisection, 2> bisections = {
      {Bisection(n_radial, shifts[0], false), Bisection(n_angular, shifts[1], true)}};

  std::vector<std::pair<Code, types::global_dof_index>> codes(handler.n_dofs());
  std::vector<types::global_dof_index> dofs(element.n_dofs_per_cell());
  std::array<std::vector<Code>, 2> lines = {{std::vector<Code>(n), std::vector<Code>(n)}};
  for (const auto& cell : handler.active_cell_iterators()) {
    const Place place = place_of(cell, n_radial);
    for (const unsigned int direction : {0, 1})
      for (unsigned int k = 0; k < n; ++k)
        lines[direction][k] =
            bisections[direction].code(place.low[direction] + place.size * places[k]);
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < dofs.size(); ++i) {
      const auto dof = dofs[numbering[i]];
      codes[dof] = {lines[0][i % n] | lines[1][i / n], dof};
    }
  }
  std::sort(codes.begin(), codes.end());
  std::vector<types::global_dof_index> order;
  order.reserve(codes.size());
  for (const auto& [code, dof] : codes)
    order.push_back(dof);
  return order;
}

} // namespace rollwave
