#include "rollwave/mesh/surface_trace.h"

#include "rollwave/mesh/line_elements.h"

namespace rollwave {

SurfaceTrace::SurfaceTrace(const RingSpace& space, const FieldVector& field)
    : edges(space.surface_faces()), nodal_values(space.surface_values(field)),
      shapes(lobatto_lagrange(space.dof_handler().get_fe().degree)) {}

double SurfaceTrace::value(unsigned int face, double t) const {
  return value_and_slope(face, t).value;
}

SurfaceTrace::ValueAndSlope SurfaceTrace::value_and_slope(unsigned int face, double t) const {
  const SurfaceFace& edge = edges[face];
  const double length = edge.end - edge.begin;
  ValueAndSlope sum = {0, 0};
  double both[2];
  for (unsigned int k = 0; k < shapes.size(); ++k) {
    shapes[k].value(t, 1, both);
    sum.value += nodal_values[edge.nodes[k]] * both[0];
    sum.slope += nodal_values[edge.nodes[k]] * both[1] / length;
  }
  return sum;
}

} // namespace rollwave
