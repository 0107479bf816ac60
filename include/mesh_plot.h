#ifndef ROLLWAVE_MESH_PLOT_H
#define ROLLWAVE_MESH_PLOT_H

#include "scene.h"
#include "solution.h"

#include <optional>
#include <string>

namespace rollwave {

/// The edges of the deformed cells in x and y, the whole ring and its contact enlarged, as SVG;
/// nullopt when gnuplot cannot draw it.
std::optional<std::string> plot_mesh(const Scene& scene, const Solution& solution);

} // namespace rollwave

#endif
