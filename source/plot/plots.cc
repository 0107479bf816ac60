#include "rollwave/plot/plots.h"

#include "rollwave/base/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace rollwave {

namespace {

/// Colours of curves; with dashes and points they can be distinguished in print as well.
const std::vector<std::string> colours = {"#0072b2", "#d55e00", "#009e73",
                                          "#cc79a7", "#000000", "#e69f00"};

/// With all digits that a picture can show.
std::string plotted(double number) {
  return std::isnan(number) ? "NaN" : rounded(number, 9);
}

/// The size of letters with which a line of @p n_letters has room in @p width, at most @p largest.
/// A legend that is too wide is not drawn at all.
unsigned int size_of_letters(double n_letters, double width, unsigned int largest) {
  constexpr double width_over_size = 0.62; // of a letter, as of most fonts without serifs
  return std::clamp<double>(width / (width_over_size * n_letters), 1, largest);
}

std::string title_in_room(const std::string& title, unsigned int width) {
  return in_single_quotes(title) + " font '," +
         std::to_string(size_of_letters(title.size(), width, 12)) + '\'';
}

/// The name of the data of curve @p i in panel @p k.
std::string block(unsigned int k, unsigned int i) {
  return "$curve_" + std::to_string(k + 1) + '_' + std::to_string(i + 1);
}

/// True if any point of the curve has the number.
bool has(const Curve& curve, double CurvePoint::*number) {
  return std::any_of(curve.points.begin(), curve.points.end(),
                     [number](const CurvePoint& point) { return !std::isnan(point.*number); });
}

/// The data of a curve: x and y; then, if any point has them, interval and mark.
void write_points(std::ostream& script, const std::string& name, const Curve& curve) {
  const bool has_more = has(curve, &CurvePoint::upper) || has(curve, &CurvePoint::mark);
  script << name << " << EOD\n";
  for (const auto& [x, y, lower, upper, mark] : curve.points) {
    script << plotted(x) << ' ' << plotted(y);
    if (has_more)
      script << ' ' << plotted(lower) << ' ' << plotted(upper) << ' ' << plotted(mark);
    script << '\n';
  }
  script << "EOD\n";
}

/// c of the line y = c x^slope, below all points.
double below(const std::vector<Curve>& curves, double slope) {
  double least = std::numeric_limits<double>::max();
  for (const Curve& curve : curves)
    for (const CurvePoint& point : curve.points)
      if (point.x > 0 && point.y > 0)
        least = std::min(least, point.y / std::pow(point.x, slope));
  return least / 2;
}

/// The style of the line of a curve.
std::string style(unsigned int curve, std::size_t n_points) {
  return "linespoints pointsize 0.6 pointinterval " + std::to_string(1 + n_points / 40) +
         " dashtype " + std::to_string(1 + curve % 4) + " pointtype " +
         std::to_string(7 - 2 * (curve / 4 % 3));
}

/// The range of y: at least a per cent of its values, so that noise does not fill the panel.
std::string y_range(const Panel& panel) {
  double least = std::numeric_limits<double>::max(), largest = -least;
  for (const Curve& curve : panel.curves)
    for (const CurvePoint& point : curve.points)
      for (const double y : {point.y, point.lower, point.upper, point.mark})
        if (!std::isnan(y)) {
          least = std::min(least, y);
          largest = std::max(largest, y);
        }
  const double span = 0.01 * std::max(std::abs(least), std::abs(largest)),
               middle = least + (largest - least) / 2;
  return largest - least < span
             ? '[' + plotted(middle - span / 2) + ':' + plotted(middle + span / 2) + ']'
             : "[*:*]";
}

/// The command that plots panel @p k. @param legend_rows of the legend of all panels; 0 for none
void plot(std::ostream& script, const Panel& panel, unsigned int k, unsigned int legend_rows) {
  script << "set xlabel " << in_single_quotes(panel.x_label) << "\nset ylabel "
         << in_single_quotes(panel.y_label) << "\nset yrange " << y_range(panel);
  if (legend_rows > 0)
    script << "\nset key at screen 0.5, 0.01 center bottom vertical maxrows " << legend_rows;
  else
    script << "\nunset key";
  // Offsets are lengths on the axis, which would lead a logarithmic one below zero.
  script << (panel.has_log_x ? "\nset logscale x\nset offsets 0, 0, 0, 0\n"
                             : "\nunset logscale x\nset offsets graph 0.03, graph 0.03, 0, 0\n"
                               "set autoscale xfix\n")
         << (panel.has_log_y ? "set" : "unset") << " logscale y\nset format '%g'\n";
  if (panel.has_log_y && !panel.has_log_x) // numbers of steps, which seldom span decades
    script << "set ytics (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 1e4, 1e5, 1e6)\n";
  std::string separator = "plot ";
  const auto add = [&](unsigned int curve, const std::string& style, const std::string& title) {
    script << separator << block(k, curve) << " using " << style << " linewidth 2 linecolor rgb '"
           << colours[curve] << "' title " << in_single_quotes(title);
    separator = ", ";
  };
  for (unsigned int i = 0; i < panel.curves.size(); ++i) // the lines lie on the bands
    if (has(panel.curves[i], &CurvePoint::upper))
      add(i, "1:3:4 with filledcurves fillstyle transparent solid 0.25 noborder", "");
  for (unsigned int i = 0; i < panel.curves.size(); ++i) {
    const Curve& curve = panel.curves[i];
    add(i, "1:2 with " + style(i, curve.points.size()), curve.title);
    if (has(curve, &CurvePoint::mark))
      add(i, "1:5 with points pointtype 6 pointsize 1.4", curve.title + " published");
  }
  for (unsigned int i = 0; i < panel.slopes.size(); ++i)
    script << ", " << below(panel.curves, panel.slopes[i]) << " * x**(" << panel.slopes[i]
           << ") with lines linewidth 1.5 linecolor rgb '#808080' dashtype " << 3 + i
           << " title 'expected slope " << panel.slopes[i] << "'";
  script << '\n';
}

} // namespace

Picture plot_panels(const std::string& name, std::string title, std::vector<Panel> panels) {
  constexpr std::size_t most_curves = 6; // that can be distinguished in one panel
  if (const std::size_t n_curves = panels.front().curves.size(); n_curves > most_curves) {
    title += "; " + std::to_string(most_curves) + " of " + std::to_string(n_curves) + " curves";
    for (Panel& panel : panels) {
      std::vector<Curve> chosen;
      for (std::size_t i = 0; i < most_curves; ++i)
        chosen.push_back(std::move(panel.curves[i * (n_curves - 1) / (most_curves - 1)]));
      panel.curves = std::move(chosen);
    }
  }
  for (Panel& panel : panels)
    for (Curve& curve : panel.curves)
      std::stable_sort(
          curve.points.begin(), curve.points.end(),
          [](const CurvePoint& left, const CurvePoint& right) { return left.x < right.x; });
  std::ostringstream script;
  script.precision(9);
  script << "set grid\n";
  for (unsigned int k = 0; k < panels.size(); ++k) // gnuplot 6 accepts no data within multiplot
    for (unsigned int i = 0; i < panels[k].curves.size(); ++i)
      write_points(script, block(k, i), panels[k].curves[i]);
  const bool is_single = panels.size() == 1;
  unsigned int n_titles = panels[0].slopes.size(),
               longest = n_titles > 0 ? std::string("expected slope -0.75").size() : 0;
  for (const Curve& curve : panels[0].curves) {
    const bool has_marks = has(curve, &CurvePoint::mark);
    n_titles += has_marks ? 2 : 1;
    longest = std::max<unsigned int>(longest, curve.title.size() + (has_marks ? 10 : 0));
  }
  const bool has_legend = n_titles > 1 || !panels[0].curves[0].title.empty();
  const unsigned int width = is_single ? 760 : 1000;
  const unsigned int letter = 9, sample = 80; // in the legend
  const unsigned int legend_columns = std::clamp(width / (letter * longest + sample), 1u, 4u);
  const unsigned int columns = is_single ? 1 : 2, rows = (panels.size() + columns - 1) / columns,
                     legend_rows =
                         has_legend ? (n_titles + legend_columns - 1) / legend_columns : 0,
                     height = (is_single ? 500 : 340 * rows) + 20 * legend_rows;
  script << "set multiplot layout " << rows << ',' << columns << " title "
         << title_in_room(title, width) << " margins " << (is_single ? 0.14 : 0.11) << ",0.96,"
         << (70. + 20 * legend_rows) / height << ',' << 1 - 45. / height << " spacing 0.13,"
         << 80. / height << "\nset key font '," << size_of_letters(longest, width - sample, 14)
         << "'\n";
  for (unsigned int k = 0; k < panels.size(); ++k)
    plot(script, panels[k], k, k == 0 ? legend_rows : 0);
  script << "unset multiplot\n";
  return {name, script.str(), width, height};
}

Picture plot_map(const std::string& title, const std::string& x_label, const std::string& y_label,
                 const std::string& value_label,
                 const std::vector<std::vector<std::array<double, 3>>>& lines) {
  // The point of each contour that has a label: off the border, also where a contour has few.
  const unsigned int labelled = std::clamp<unsigned int>(lines.size() / 4, 1, 4);
  std::ostringstream script;
  script << "$map << EOD\n";
  for (const auto& line : lines) {
    for (const auto& [x, y, value] : line)
      script << plotted(x) << ' ' << plotted(y) << ' ' << plotted(value) << '\n';
    script << '\n';
  }
  script << "EOD\nset datafile missing 'NaN'\nset contour base\nset cntrparam levels 10\n"
            "unset surface\nset table $contours\nsplot $map\nunset table\nunset contour\n"
            "set surface\nset view map\nset autoscale xfix\nset autoscale yfix\nunset key\n"
            "set style textbox opaque noborder fillcolor rgb '#ffffff' margins 0.3,0.3\n"
            "set palette defined (0 '#fff7bc', 0.5 '#41b6c4', 1 '#081d58')\nset title "
         << title_in_room(title, 760) << "\nset xlabel " << in_single_quotes(x_label)
         << "\nset ylabel " << in_single_quotes(y_label) << "\nset cblabel "
         << in_single_quotes(value_label)
         << "\nset pm3d interpolate 8,8\n"
            "splot $map with pm3d, $contours with lines linecolor rgb '#000000' linewidth 1, "
            "$contours using 1:2:3:(sprintf('%.3g', $3)) every ::"
         << labelled << "::" << labelled << " with labels boxed font ',10'\n";
  return {"study-map", script.str(), 760, 560};
}

} // namespace rollwave
