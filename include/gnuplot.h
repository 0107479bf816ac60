#ifndef ROLLWAVE_GNUPLOT_H
#define ROLLWAVE_GNUPLOT_H

#include <optional>
#include <string>

namespace rollwave {

/// The SVG that gnuplot draws for @p script, which must not set a terminal; nullopt when gnuplot is
/// not installed or refuses the script. @p width and @p height are in points.
std::optional<std::string> draw_svg(const std::string& script, unsigned int width,
                                    unsigned int height);

} // namespace rollwave

#endif
