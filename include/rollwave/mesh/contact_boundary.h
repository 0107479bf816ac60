#pragma once

#include "rollwave/mesh/ring_space.h"

#include <optional>
#include <utility>
#include <vector>

namespace rollwave {

/// The part of r = b where contact is possible: the nodes of a space in a zone [z0, z1] of angles,
/// a stretch of RingSpace::surface_nodes(). The space must outlive it.
class ContactBoundary {
public:
  /// @throws BadInput where no node of the mesh lies in the zone.
  ContactBoundary(const RingSpace& space, const std::pair<double, double>& zone);

  const RingSpace& space() const { return *ring; }

  /// The contact nodes by increasing angle.
  const std::vector<SurfaceNode>& contact_nodes() const { return nodes; }
  unsigned int size() const { return nodes.size(); }

  /// The number of the first contact node among the surface nodes.
  unsigned int first_surface_node() const { return first; }

  /// The number among contact_nodes() of a node of surface_nodes(), if it is one.
  std::optional<unsigned int> contact_number(unsigned int surface_node) const {
    if (surface_node < first || surface_node >= first + size())
      return {};
    return surface_node - first;
  }

private:
  const RingSpace* ring;
  unsigned int first;
  std::vector<SurfaceNode> nodes;
};

} // namespace rollwave
