#ifndef ROLLWAVE_OUTPUT_GNUPLOT_H
#define ROLLWAVE_OUTPUT_GNUPLOT_H

#include <cstdio>
#include <memory>
#include <string>

namespace rollwave {

/// A picture as SVG, or the reason why there is none.
struct Picture {
  std::string svg;
  std::string failure; ///< empty where there is a picture
};

/// gnuplot at work on a picture, in a process of its own, while this one goes on.
class Drawing {
public:
  /// Starts with @p script, which must not set a terminal; @p width and @p height are in points.
  Drawing(const std::string& script, unsigned int width, unsigned int height);

  /// Waits for the picture; to be called once.
  Picture take();

private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  struct Wait {
    void operator()(std::FILE* pipe) const { pclose(pipe); }
  };
  std::unique_ptr<std::FILE, Close> messages; ///< of gnuplot
  std::unique_ptr<std::FILE, Wait> pipe;
  std::string failure; ///< to start it
};

} // namespace rollwave

#endif
