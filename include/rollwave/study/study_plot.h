#pragma once

#include "rollwave/output/gnuplot.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace rollwave {

/// Points in x and y, the latter not a number where there is a gap.
using Points = std::vector<std::pair<double, double>>;

/// An interval of y; its ends are not a number where there is a gap.
struct BandPoint {
  double x, lower, upper;
};

/// One curve of a panel: its points joined by lines.
struct Curve {
  std::string title;
  Points points;
  Points marks = {};                ///< further points, shown as open circles
  std::vector<BandPoint> band = {}; ///< drawn behind the curves, if it is wider than a line
};

/// A pair of axes with curves.
struct Panel {
  std::string x_label, y_label;
  std::vector<Curve> curves;
  bool has_log_x = false, has_log_y = false;
  std::vector<double> slopes = {}; ///< expected powers of x, drawn as dotted lines below the curves
};

/// Panels in rows of two. They have the same curves, with one legend below them. Of more
/// than six curves it shows six, equally spaced, and the title says so.
Picture plot_panels(const std::string& name, std::string title, std::vector<Panel> panels);

/// Values over a grid of x and y as colours with contour lines, in lines of constant x.
Picture plot_map(const std::string& title, const std::string& x_label, const std::string& y_label,
                 const std::string& value_label,
                 const std::vector<std::vector<std::array<double, 3>>>& lines);

} // namespace rollwave
