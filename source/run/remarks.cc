#include "rollwave/run/remarks.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace rollwave {

namespace {

/// How deep the surface lies in the road outside of the zone, where the road does not hold it. Only
/// its lower half meets the road.
double depth_outside(const Scene& scene, const Result& result) {
  double depth = 0;
  for (const SurfacePoint& point : result.surface)
    if (!scene.is_in_zone(point.angle) && std::sin(point.angle) < 0)
      depth = std::max(depth, point.displacement - scene.road(point.angle));
  return depth;
}

std::string rounded(double value) {
  std::ostringstream text;
  text << std::setprecision(2) << value;
  return text.str();
}

} // namespace

std::vector<std::string> remarks_on(const Scene& scene, const RunOptions& options,
                                    const Result& result) {
  std::vector<std::string> remarks;
  const auto& ends = result.patch.ends;
  const unsigned int active_nodes = result.patch.active_nodes;
  if (ends && (ends->first == scene.zone_begin || ends->second == scene.zone_end))
    remarks.push_back(
        options.road.contact_zone
            ? "the zone cuts the contact short: the pressure is unbounded at its end, "
              "where peak_pressure grows with each refinement"
            : "contact reaches the end of the automatic zone, where phi = b; give a "
              "wider Road/Contact zone if it may go on");
  const double depth = depth_outside(scene, result) / scene.outer_radius;
  if (options.road.contact_zone && depth > 1e-9)
    remarks.push_back("outside of the zone, where there is no contact, the surface lies up to " +
                      rounded(depth) +
                      " b within the road; give a wider Road/Contact zone if it shall not");
  if (result.certified && !(result.certified->relative < 1)) {
    std::string remark = "the certified relative error is 1 or more, so that no digit is certified";
    if (options.mesh.wanted_relative_error == 0)
      remark += "; refine, or set Mesh/Wanted relative error";
    if (std::isinf(result.certified->force_data))
      remark = "there is no bound: f^2 grows without end towards one place, as at a pole";
    remarks.push_back(remark);
  }
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
