#ifndef ROLLWAVE_OUTPUT_GNUPLOT_H
#define ROLLWAVE_OUTPUT_GNUPLOT_H

#include <cstdio>
#include <memory>
#include <optional>
#include <string>

namespace rollwave {

/// gnuplot at work on a picture, in a process of its own, while this one goes on.
class Drawing {
public:
  /// Starts with @p script, which must not set a terminal; @p width and @p height are in points.
  Drawing(const std::string& script, unsigned int width, unsigned int height);

  /// The picture as SVG, when it is finished; nullopt when gnuplot is not installed or refuses the
  /// script, or the picture has been taken.
  std::optional<std::string> take_svg();

private:
  struct Close {
    void operator()(std::FILE* pipe) const { pclose(pipe); }
  };
  std::unique_ptr<std::FILE, Close> pipe;
};

} // namespace rollwave

#endif
