#include "rollwave/mesh/cell_places.h"

#include <deal.II/grid/cell_id.h>

namespace rollwave {

using namespace dealii;

CellPlaces::CellPlaces(const Triangulation<2>& triangulation) {
  const double first_angle = triangulation.begin(0)->vertex(0)[1];
  for (const auto& cell : triangulation.cell_iterators_on_level(0)) {
    if (cell->vertex(0)[1] != first_angle)
      break;
    ++n_radial_cells;
  }
  n_angular_cells = triangulation.n_cells(0) / n_radial_cells;
}

CellPlace CellPlaces::of(const Triangulation<2>::active_cell_iterator& cell) const {
  const CellId id = cell->id();
  CellPlace place = {{{double(id.get_coarse_cell_id() % n_radial_cells),
                       double(id.get_coarse_cell_id() / n_radial_cells)}},
                     1};
  for (const unsigned int child : id.get_child_indices()) {
    place.size /= 2;
    place.low[0] += place.size * (child % 2);
    place.low[1] += place.size * (child / 2);
  }
  return place;
}

} // namespace rollwave
