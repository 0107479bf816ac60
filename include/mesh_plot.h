#ifndef ROLLWAVE_MESH_PLOT_H
#define ROLLWAVE_MESH_PLOT_H

#include "gnuplot.h"
#include "scene.h"
#include "solution.h"

#include <optional>

namespace rollwave {

/// The edges of the deformed cells in x and y, the whole ring and its contact enlarged, on the
/// first process.
std::optional<Drawing> plot_mesh(const Scene& scene, const Solution& solution);

} // namespace rollwave

#endif
