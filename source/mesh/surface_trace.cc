#include "rollwave/mesh/surface_trace.h"

#include "rollwave/mesh/line_elements.h"

namespace rollwave {

SurfaceTrace::SurfaceTrace(const RingSpace& space, const FieldVector& field)
    : surface_edges(space.surface_edges()), nodal_values(space.surface_values(field)),
      shapes(lobatto_lagrange(space.dof_handler().get_fe().degree)) {}

double SurfaceTrace::value(unsigned int edge, double t) const {
  return value_and_slope(edge, t).value;
}

SurfaceTrace::ValueAndSlope SurfaceTrace::value_and_slope(unsigned int edge, double t) const {
  const auto& [begin, end, nodes] = surface_edges[edge];
  ValueAndSlope sum = {0, 0};
  double both[2];
  for (unsigned int k = 0; k < shapes.size(); ++k) {
    shapes[k].value(t, 1, both);
    sum.value += nodal_values[nodes[k]] * both[0];
    sum.slope += nodal_values[nodes[k]] * both[1] / (end - begin);
  }
  return sum;
}

} // namespace rollwave
