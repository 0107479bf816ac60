#include "rollwave/mesh/contact_boundary.h"

#include "rollwave/base/errors.h"
#include "rollwave/scene/scene.h"

#include <algorithm>
#include <string>

namespace rollwave {

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

} // namespace rollwave
