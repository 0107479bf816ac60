#include "rollwave/mesh/contact_boundary.h"

#include "rollwave/base/errors.h"
#include "rollwave/scene/scene.h"

#include <algorithm>
#include <string>

namespace rollwave {

using namespace dealii;

ContactBoundary::ContactBoundary(const RingSpace& space, const std::pair<double, double>& zone)
    : ring(&space) {
  const auto& surface = space.surface_nodes();
  const auto is_inside = [&](const SurfaceNode& node) { return lies_in_zone(node.angle, zone); };
  const auto begin = std::find_if(surface.begin(), surface.end(), is_inside),
             end = std::find_if_not(begin, surface.end(), is_inside);
  if (begin == end)
    throw BadInput("no node of the mesh lies in the contact zone from " +
                   std::to_string(zone.first) + " to " + std::to_string(zone.second) +
                   "; raise Mesh/Angular cells or widen Road/Contact zone");
  first = begin - surface.begin();
  nodes.assign(begin, end);
}

Vector<double> ContactBoundary::contact_values(const FieldVector& field) const {
  const std::vector<double> values = ring->surface_values(field);
  const auto begin = values.begin() + first;
  return Vector<double>(begin, begin + size());
}

} // namespace rollwave
