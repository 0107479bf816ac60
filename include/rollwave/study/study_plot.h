#pragma once

#include "rollwave/output/gnuplot.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace rollwave {

/// Points in x and y, the latter not a number where there is a gap.
using Points = std::vector<std::pair<double, double>>;

struct Curve {
  std::string title;
  Points points;
  Points marks = {}; ///< further points, shown as open circles
};

struct Panel {
  std::string x_label, y_label;
  std::vector<Curve> curves;
  bool has_log_x = false, has_log_y = false;
  std::vector<double> slopes = {}; ///< expected powers of x, drawn as dotted lines below the curves
};

/// The most curves that can be distinguished in one panel.
constexpr unsigned int most_curves = 6;

/// At most @p most of the numbers 0 to n - 1, equally spaced.
std::vector<unsigned int> equidistant_numbers(unsigned int n, unsigned int most);

/// Panels in rows of two. They have the same curves, with one legend below them. If there are more
/// than most_curves curves, it shows most_curves of them, equally spaced, and the title says so.
Picture plot_panels(std::string title, std::vector<Panel> panels);

/// Values over a grid of x and y as colours with contour lines, in lines of constant x.
Picture plot_map(const std::string& title, const std::string& x_label, const std::string& y_label,
                 const std::string& value_label,
                 const std::vector<std::vector<std::array<double, 3>>>& lines);

} // namespace rollwave
