#ifndef ROLLWAVE_ADAPT_CELL_RESIDUAL_H
#define ROLLWAVE_ADAPT_CELL_RESIDUAL_H

#include "rollwave/mesh/ring_mesh.h"
#include "rollwave/mesh/tensor_elements.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <array>
#include <vector>

namespace rollwave {

/// On a line through a cell.
constexpr unsigned int most_nodes = highest_degree + 1;
using NodeValues = std::array<double, most_nodes>;

/// Shape functions on [0, 1] with two derivatives at some points.
struct LineShapes {
  std::vector<NodeValues> value, first, second;

  LineShapes(unsigned int degree, const std::vector<double>& points) {
    std::vector<double> all(3);
    const auto lagrange = lobatto_lagrange(degree);
    for (const double t : points) {
      for (auto* const list : {&value, &first, &second})
        list->emplace_back();
      for (unsigned int i = 0; i <= degree; ++i) {
        lagrange[i].value(t, all);
        value.back()[i] = all[0];
        first.back()[i] = all[1];
        second.back()[i] = all[2];
      }
    }
  }
};

/// u on one cell by its nodal values, the radial index running fastest.
struct CellField {
  explicit CellField(unsigned int n) : n(n) {}

  unsigned int n;
  std::array<double, most_nodes * most_nodes> nodal;

  double sum(const NodeValues& radial, const NodeValues& angular) const {
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

/// @p points on [0, 1] mapped to [begin, end].
std::vector<double> mapped(const std::vector<dealii::Point<1>>& points, double begin, double end);

struct Rectangle {
  double r0, r1, z0, z1;
  double height() const { return r1 - r0; }
  double length() const { return z1 - z0; }
};

Rectangle rectangle_of(const dealii::DoFHandler<2>::active_cell_iterator& cell);

/// r f on one cell: the polynomial of a degree less than the element's that equals it at Gauss'
/// points. What is left varies too fast for the residual to tell how large its error is.
class ForceMoment {
public:
  /// @param rule at whose points it is asked for, in each direction
  ForceMoment(unsigned int degree, const dealii::Quadrature<1>& rule);

  void reinit(const Scene& scene, const Rectangle& box);

  double value(unsigned int p, unsigned int q) const;

private:
  const dealii::QGauss<1> gauss;
  dealii::FullMatrix<double> to_points, at_gauss; ///< rows of the latter in z
};

/// The squares of the lengths, over r, that turn a residual into the energy norm of what a cell
/// cannot resolve, by the direction in which that varies.
struct Lengths {
  double radial;  ///< h_r^2 / r
  double angular; ///< h_z^2 / (alpha r)
  double both() const { return std::min(radial, angular); }
};

Lengths lengths_of(const Rectangle& box, const Scene& scene);

/// At the points of a product of rules on a cell, z in rows and r in columns.
using ResidualValues = std::array<NodeValues, most_nodes>;

/// The mean over a cell of the square of a residual, its values at the points of @p rule in each
/// direction, with the length of its direction for what varies in one direction only, and the
/// lesser length for all else.
double weighted_square(unsigned int n, const ResidualValues& residual,
                       const dealii::QGauss<1>& rule, const Lengths& length);

} // namespace rollwave

#endif
