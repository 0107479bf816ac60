#ifndef ROLLWAVE_MESH_GRADED_QUADRATURE_H
#define ROLLWAVE_MESH_GRADED_QUADRATURE_H

#include <deal.II/base/quadrature.h>

#include <vector>

namespace rollwave {

/// A quadrature rule for dr on a radial interval.
struct RadialRule {
  std::vector<double> r;
  std::vector<double> weight;
};

/// @p points on each of the pieces, all of one ratio of radii, 2 at most, that [begin, end] is cut
/// into: the integrands are smooth but for a pole at r = 0.
RadialRule graded_rule(double begin, double end, const dealii::Quadrature<1>& points);

} // namespace rollwave

#endif
