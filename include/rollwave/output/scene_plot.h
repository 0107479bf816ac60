#pragma once

#include "rollwave/parameters/parameters.h"
#include "rollwave/plot/gnuplot.h"
#include "rollwave/run/result.h"
#include "rollwave/scene/scene.h"

namespace rollwave {

/// The scene; the surroundings of the contact at true scale; gap and pressure there over the length
/// along the road. The title has the scene, the material and the main results.
Picture plot_scene(const Scene& scene, const Parameters& parameters, const Result& result);

} // namespace rollwave
