#include "remarks.h"

#include <algorithm>
#include <cmath>

namespace rollwave {

std::vector<std::string> remarks_on(const Scene& scene, const Parameters& parameters,
                                    const Result& result) {
  std::vector<std::string> remarks;
  const auto& ends = result.patch.ends;
  const unsigned int active_nodes = result.patch.active_nodes;
  if (ends && (ends->first == scene.zone_begin || ends->second == scene.zone_end))
    remarks.push_back(
        parameters.road.contact_zone
            ? "the zone cuts the contact short: the pressure is unbounded at its end, "
              "where peak_pressure grows with each refinement"
            : "contact reaches the end of the automatic zone, where phi = b; give a "
              "wider Road/Contact zone if it may go on");
  constexpr unsigned int few_nodes = 2;
  if (0 < active_nodes && active_nodes <= few_nodes)
    remarks.push_back("contact is held by " + std::to_string(active_nodes) +
                      (active_nodes == 1 ? " node" : " nodes") +
                      ", so that force, ends and pressure are rough; raise Mesh/Angular cells, or "
                      "set Mesh/Wanted relative error");
  const auto largest = std::max_element(
      result.surface.begin(), result.surface.end(), [](const auto& one, const auto& other) {
        return std::abs(one.displacement) < std::abs(other.displacement);
      });
  if (largest != result.surface.end() &&
      std::abs(largest->displacement) > scene.outer_radius - scene.inner_radius)
    remarks.push_back("the surface is displaced by more than the ring is thick, for which the "
                      "linear model is not meant");
  return remarks;
}

} // namespace rollwave
