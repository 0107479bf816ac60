#ifndef ROLLWAVE_ADAPT_CELL_FIELD_H
#define ROLLWAVE_ADAPT_CELL_FIELD_H

#include "rollwave/mesh/line_elements.h"
#include "rollwave/mesh/ring_mesh.h"

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace rollwave {

/// For the nodes or the points on one side of a cell.
using SideValues = std::array<double, highest_degree + 1>;

/// Shape functions with two derivatives at points of [0, 1], their values in rows.
struct LineShapes {
  std::vector<SideValues> value, first, second;

  LineShapes(unsigned int degree, const std::vector<double>& points)
      : value(points.size()), first(points.size()), second(points.size()) {
    std::vector<double> all(3);
    const auto lagrange = lobatto_lagrange(degree);
    for (unsigned int q = 0; q < points.size(); ++q)
      for (unsigned int i = 0; i <= degree; ++i) {
        lagrange[i].value(points[q], all);
        value[q][i] = all[0];
        first[q][i] = all[1];
        second[q][i] = all[2];
      }
  }
};

/// u on one cell by its nodal values, the radial index running fastest.
struct CellField {
  unsigned int n; ///< nodes on each side
  dealii::Point<2> low;
  dealii::Tensor<1, 2> size;
  std::array<double, (highest_degree + 1) * (highest_degree + 1)> nodal;

  double sum(const SideValues& radial, const SideValues& angular) const {
    double result = 0;
    for (unsigned int j = 0; j < n; ++j) {
      double row = 0;
      for (unsigned int i = 0; i < n; ++i)
        row += radial[i] * nodal[i + n * j];
      result += angular[j] * row;
    }
    return result;
  }
};

} // namespace rollwave

#endif
