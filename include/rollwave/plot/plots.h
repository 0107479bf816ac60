#pragma once

#include "rollwave/plot/gnuplot.h"

#include <optional>
#include <string>
#include <vector>

namespace rollwave {

/// A point of a curve. A number that is not known leaves a gap.
struct CurvePoint {
  double x;
  std::optional<double> y;
  std::optional<double> lower = {}, upper = {}; ///< an interval that is drawn as part of a band
  std::optional<double> mark = {};              ///< a further y, shown as an open circle
};

/// A point of a map.
struct MapPoint {
  double x, y;
  std::optional<double> value;
};

/// The numbers of a curve's colour and of its dashes.
struct LineStyle {
  unsigned int colour, dashes;
};

/// One curve of a panel: its points joined by lines, in the order of x.
struct Curve {
  std::string title;
  std::vector<CurvePoint> points;
  std::optional<LineStyle> style = {}; ///< otherwise one of its own
};

/// A pair of axes with curves.
struct Panel {
  std::string x_label, y_label;
  std::vector<Curve> curves;
  bool has_log_x = false, has_log_y = false;
  std::vector<double> slopes = {}; ///< expected powers of x, drawn as dotted lines below the curves
};

/// A panel shows at most this many curves: the eye does not tell more of them apart.
constexpr unsigned int most_curves = 6;

/// Up to @p most of the numbers 0 to n - 1, equally spaced, with the first and the last one.
std::vector<unsigned int> spread(unsigned int n, unsigned int most);

/// Panels in rows of two. They have the same curves, with one legend below them. Of more than
/// most_curves it shows as many, equally spaced, and the title says so.
Picture plot_panels(const std::string& name, std::string title, std::vector<Panel> panels);

/// Values over a grid of x and y, in lines of constant x: a cell of colour for each, which ends in
/// the middle between neighbours, and contour lines. Of more than 70 values of x or y it shows 70,
/// and the title says so: each cell takes about 120 bytes.
Picture plot_map(std::string title, const std::string& x_label, const std::string& y_label,
                 const std::string& value_label, const std::vector<std::vector<MapPoint>>& lines);

} // namespace rollwave
