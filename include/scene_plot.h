#ifndef ROLLWAVE_SCENE_PLOT_H
#define ROLLWAVE_SCENE_PLOT_H

#include "gnuplot.h"
#include "result.h"
#include "scene.h"

namespace rollwave {

/// The undeformed and the deformed outline on the road; over the contact and half as much on
/// both sides, or the zone without contact, surface and road, and the pressure.
Drawing plot_scene(const Scene& scene, const Parameters& parameters, const Result& result);

} // namespace rollwave

#endif
