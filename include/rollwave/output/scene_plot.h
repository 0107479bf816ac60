#ifndef ROLLWAVE_OUTPUT_SCENE_PLOT_H
#define ROLLWAVE_OUTPUT_SCENE_PLOT_H

#include "rollwave/output/gnuplot.h"
#include "rollwave/run/result.h"
#include "rollwave/scene/scene.h"

namespace rollwave {

/// The undeformed and the deformed outline on the road; over the contact and half as much on
/// both sides, or the zone without contact, surface and road, and the pressure.
Drawing plot_scene(const Scene& scene, const Result& result);

} // namespace rollwave

#endif
