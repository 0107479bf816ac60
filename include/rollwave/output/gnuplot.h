#ifndef ROLLWAVE_OUTPUT_GNUPLOT_H
#define ROLLWAVE_OUTPUT_GNUPLOT_H

#include <string>

namespace rollwave {

/// A picture as SVG, or the reason why there is none.
struct Picture {
  std::string svg;
  std::string failure; ///< empty where there is a picture
};

/// What gnuplot draws by @p script, which must not set a terminal; @p width and @p height are in
/// points.
Picture draw(const std::string& script, unsigned int width, unsigned int height);

} // namespace rollwave

#endif
