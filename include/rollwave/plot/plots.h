#pragma once

#include "rollwave/plot/gnuplot.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace rollwave {

/// A point of a curve. A number that is not known is NaN, and leaves a gap.
struct CurvePoint {
  double x, y;
  double lower = NAN, upper = NAN; ///< an interval that is drawn as part of a band
  double mark = NAN;               ///< a further y, shown as an open circle
};

/// One curve of a panel: its points joined by lines, in the order of x.
struct Curve {
  std::string title;
  std::vector<CurvePoint> points;
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
