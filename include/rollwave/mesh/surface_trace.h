#pragma once

#include "rollwave/mesh/ring_space.h"

#include <deal.II/base/polynomial.h>

#include <vector>

namespace rollwave {

/**
 * The trace u_h(b, z) of a discrete displacement. On each of RingSpace::surface_edges(), with the
 * coordinate t = (z - begin) / (end - begin) in [0, 1],
 *
 *     u_h(b, z) = sum_k u_k L_k(t),
 *
 * u_k being the values at the nodes of the edge and L_k their Lagrange polynomials.
 */
class SurfaceTrace {
public:
  /// Called on all processes; each gets the trace in full.
  SurfaceTrace(const RingSpace& space, const FieldVector& field);

  const std::vector<SurfaceEdge>& edges() const { return surface_edges; }

  /// u_h at a point of an edge, a length.
  double value(unsigned int edge, double t) const;

  struct ValueAndSlope {
    double value; ///< u_h, a length
    double slope; ///< du_h/dz, a length
  };
  ValueAndSlope value_and_slope(unsigned int edge, double t) const;

private:
  std::vector<SurfaceEdge> surface_edges;
  std::vector<double> nodal_values; ///< at the surface nodes
  std::vector<dealii::Polynomials::Polynomial<double>> shapes;
};

} // namespace rollwave
