#pragma once

#include "rollwave/output/gnuplot.h"
#include "rollwave/run/result.h"
#include "rollwave/scene/scene.h"

namespace rollwave {

/// True if the user has given a material or names of units: pictures then show gap and pressure
/// over the length along the road, otherwise over the angle.
bool has_own_units(const Units& units);

/// The scene; the surroundings of the contact at true scale; gap and pressure there.
Picture plot_scene(const Scene& scene, const Result& result);

} // namespace rollwave
