#ifndef ROLLWAVE_SCENE_PLOT_H
#define ROLLWAVE_SCENE_PLOT_H

#include "result.h"
#include "scene.h"

#include <optional>
#include <string>

namespace rollwave {

/// A picture as SVG: the undeformed and the deformed outline on the road, and the pressure over the
/// contact zone. nullopt when gnuplot cannot draw it.
std::optional<std::string> plot_scene(const Scene& scene, const Parameters& parameters,
                                      const Result& result);

} // namespace rollwave

#endif
