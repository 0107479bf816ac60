#pragma once

#include "rollwave/run/result.h"
#include "rollwave/scene/scene.h"

#include <string>

namespace rollwave {

/// The deformed surface as VTU, one closed line through its nodes, with the point fields `angle`
/// z, `displacement` u, `pressure` lambda and `gap` phi - u, which is not a number where the road
/// is not within b of the surface.
std::string surface_vtu(const Scene& scene, const Result& result);

/// The road as VTU, a line with the point field `angle`.
std::string road_vtu(const Scene& scene);

} // namespace rollwave
