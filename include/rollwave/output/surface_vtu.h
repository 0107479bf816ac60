#ifndef ROLLWAVE_OUTPUT_SURFACE_VTU_H
#define ROLLWAVE_OUTPUT_SURFACE_VTU_H

#include "rollwave/run/result.h"
#include "rollwave/scene/scene.h"

#include <string>
#include <utility>
#include <vector>

namespace rollwave {

/// The deformed surface as VTU, one closed line through its nodes, with the point fields `angle`
/// z, `displacement` u, `pressure` lambda and `gap` phi - u, which is not a number where the road
/// is not within b of the surface.
std::string surface_vtu(const Scene& scene, const Result& result);

/// The road as VTU, a line with the point field `angle`.
std::string road_vtu(const Scene& scene);

/// Points (x, y) of the road, a line or a circle of the curvature kappa, equally spaced by their
/// way s from the lowest point: x = sin(kappa s) / kappa, y = -c - (1 - cos(kappa s)) / kappa with
/// |s|
/// <= @p longest; of a drum at most once around, of the inside of one the lower half.
std::vector<std::pair<double, double>> points_of_road(const Scene& scene, double longest);

} // namespace rollwave

#endif
