#ifndef ROLLWAVE_MESH_CELL_PLACES_H
#define ROLLWAVE_MESH_CELL_PLACES_H

#include <deal.II/grid/tria.h>

#include <array>

namespace rollwave {

/// The place of a cell in units of coarse cells, (radial, angular), exact in binary arithmetic.
struct CellPlace {
  std::array<double, 2> low;
  double size;
};

/// Of a mesh whose coarse cells are numbered with the radial index running fastest, and all known
/// to this process.
class CellPlaces {
public:
  explicit CellPlaces(const dealii::Triangulation<2>& triangulation);

  CellPlace of(const dealii::Triangulation<2>::active_cell_iterator& cell) const;

  unsigned int n_radial() const { return n_radial_cells; } ///< coarse cells
  unsigned int n_angular() const { return n_angular_cells; }

private:
  unsigned int n_radial_cells = 0, n_angular_cells = 0;
};

} // namespace rollwave

#endif
