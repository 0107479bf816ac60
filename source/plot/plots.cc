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

/// With all digits that a picture can show; gnuplot's word for a number that is not known.
std::string plotted(std::optional<double> number) {
  return number ? rounded(*number, 9) : "NaN";
}

/// The name of the data of curve @p i in panel @p k.
std::string block(unsigned int k, unsigned int i) {
  return "$curve_" + std::to_string(k + 1) + '_' + std::to_string(i + 1);
}

/// True if any point of the curve has the number.
bool has(const Curve& curve, std::optional<double> CurvePoint::*number) {
  return std::any_of(curve.points.begin(), curve.points.end(),
                     [number](const CurvePoint& point) { return (point.*number).has_value(); });
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
        least = std::min(least, *point.y / std::pow(point.x, slope));
  return least / 2;
}

LineStyle style_of(const Panel& panel, unsigned int curve) {
  return panel.curves[curve].style.value_or(LineStyle{curve, curve});
}

/// The style of the line of a curve.
std::string style(const LineStyle& line, std::size_t n_points) {
  return "linespoints pointsize 0.6 pointinterval " + std::to_string(1 + n_points / 40) +
         " dashtype " + std::to_string(1 + line.dashes % 4) + " pointtype " +
         std::to_string(7 - 2 * (line.dashes / 4 % 3));
}

/// The range of y: at least a per cent of its values, so that noise does not fill the panel.
std::string y_range(const Panel& panel) {
  double least = std::numeric_limits<double>::max(), largest = -least;
  for (const Curve& curve : panel.curves)
    for (const CurvePoint& point : curve.points)
      for (const auto& y : {point.y, point.lower, point.upper, point.mark})
        if (y) {
          least = std::min(least, *y);
          largest = std::max(largest, *y);
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
           << colours[style_of(panel, curve).colour % colours.size()] << "' title "
           << in_single_quotes(title);
    separator = ", ";
  };
  for (unsigned int i = 0; i < panel.curves.size(); ++i) // the lines lie on the bands
    if (has(panel.curves[i], &CurvePoint::upper))
      add(i, "1:3:4 with filledcurves fillstyle transparent solid 0.25 noborder", "");
  for (unsigned int i = 0; i < panel.curves.size(); ++i) {
    const Curve& curve = panel.curves[i];
    add(i, "1:2 with " + style(style_of(panel, i), curve.points.size()), curve.title);
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

std::vector<unsigned int> spread(unsigned int n, unsigned int most) {
  std::vector<unsigned int> chosen;
  const unsigned int count = std::min(n, most);
  for (unsigned int i = 0; i < count; ++i)
    chosen.push_back(count < n && count > 1 ? i * std::size_t(n - 1) / (count - 1) : i);
  return chosen;
}

Picture plot_panels(const std::string& name, std::string title, std::vector<Panel> panels) {
  if (const std::size_t n_curves = panels.front().curves.size(); n_curves > most_curves) {
    title += ", " + std::to_string(most_curves) + " of " + std::to_string(n_curves) +
             " curves at equal distances";
    for (Panel& panel : panels) {
      std::vector<Curve> chosen;
      for (const unsigned int i : spread(n_curves, most_curves))
        chosen.push_back(std::move(panel.curves[i]));
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
  script << set_grid << (panels.size() > 1 ? "set tics font ',11'\n" : "");
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
  const unsigned int width = is_single && n_titles <= 4 ? 760 : 1000;
  const unsigned int letter = 9, sample = 80; // in the legend
  const Title heading = title_in_room(title, width);
  const unsigned int legend_columns = std::clamp(width / (letter * longest + sample), 1u, 4u);
  const unsigned int columns = is_single ? 1 : 2, rows = (panels.size() + columns - 1) / columns,
                     legend_rows =
                         has_legend ? (n_titles + legend_columns - 1) / legend_columns : 0,
                     above = 30 + 16 * heading.n_lines, below_axes = 85 + 24 * legend_rows,
                     height = (is_single ? 420 : 300 * rows) + above + below_axes;
  script << "set multiplot layout " << rows << ',' << columns << " title " << heading.text
         << " margins " << (is_single ? 110. / width : 0.11) << ",0.96," << 1. * below_axes / height
         << ',' << 1 - 1. * above / height << " spacing 0.13," << 80. / height
         << "\nset key font '," << size_of_letters(longest, width - sample, 14) << "'\n";
  for (unsigned int k = 0; k < panels.size(); ++k)
    plot(script, panels[k], k, k == 0 ? legend_rows : 0);
  script << "unset multiplot\n";
  return {name, script.str(), width, height};
}

namespace {

/// Where the cells of these places end: in the middle between neighbours, and as far outside.
std::vector<double> ends_of_cells(const std::vector<double>& places) {
  std::vector<double> ends = {0};
  for (std::size_t i = 1; i < places.size(); ++i)
    ends.push_back(places[i - 1] + (places[i] - places[i - 1]) / 2);
  ends.front() = 2 * places.front() - ends[1];
  ends.push_back(2 * places.back() - ends.back());
  return ends;
}

/// The part of a range in which a label has room.
std::string has_room(const std::string& column, const std::vector<double>& ends, double border) {
  const double width = border * (ends.back() - ends.front());
  return column + " > " + plotted(ends.front() + width) + " && " + column + " < " +
         plotted(ends.back() - width);
}

} // namespace

Picture plot_map(std::string title, const std::string& x_label, const std::string& y_label,
                 const std::string& value_label, const std::vector<std::vector<MapPoint>>& lines) {
  constexpr unsigned int most_cells = 70, width = 800;
  const auto of_x = spread(lines.size(), most_cells), of_y = spread(lines[0].size(), most_cells);
  if (of_x.size() < lines.size() || of_y.size() < lines[0].size())
    title += ", " + std::to_string(of_x.size()) + " x " + std::to_string(of_y.size()) + " of " +
             std::to_string(lines.size()) + " x " + std::to_string(lines[0].size()) + " runs";
  std::vector<double> x, y;
  for (const unsigned int i : of_x)
    x.push_back(lines[i][0].x);
  for (const unsigned int j : of_y)
    y.push_back(lines[0][j].y);
  const auto x_ends = ends_of_cells(x), y_ends = ends_of_cells(y);
  std::ostringstream script;
  script << "$map << EOD\n";
  for (unsigned int i = 0; i < x.size(); ++i) {
    for (unsigned int j = 0; j < y.size(); ++j)
      script << plotted(x[i]) << ' ' << plotted(y[j]) << ' '
             << plotted(lines[of_x[i]][of_y[j]].value) << ' ' << plotted(x_ends[i]) << ' '
             << plotted(x_ends[i + 1]) << ' ' << plotted(y_ends[j]) << ' ' << plotted(y_ends[j + 1])
             << '\n';
    script << '\n';
  }
  // Of the points of a contour some have a label, if they are off the axes.
  const std::size_t labelled = std::max<std::size_t>(x.size() / 2, 2);
  const Title heading = title_in_room(title, width);
  const unsigned int height = 560 + 16 * heading.n_lines;
  script << "EOD\nset datafile missing 'NaN'\nset contour base\nset cntrparam levels 8\n"
            "unset surface\nset table $contours\nsplot $map\nunset table\nunset contour\n"
            "unset key\nset style textbox opaque noborder fillcolor rgb '#ffffff' margins 0.3,0.3\n"
            "set palette defined (0 '#fff7bc', 0.5 '#41b6c4', 1 '#081d58')\nset title "
         << heading.text << "\nset xlabel " << in_single_quotes(x_label) << "\nset ylabel "
         << in_single_quotes(y_label) << "\nset cblabel " << in_single_quotes(value_label)
         << " offset 1\nset rmargin at screen 0.79\nset xrange [" << plotted(x_ends.front()) << ':'
         << plotted(x_ends.back()) << "]\nset yrange [" << plotted(y_ends.front()) << ':'
         << plotted(y_ends.back())
         << "]\nset format '%g'\nset tics out nomirror\n"
            "plot $map using 1:2:4:5:6:7:3 with boxxyerror fillstyle solid noborder fillcolor "
            "palette, $contours using 1:2 with lines linecolor rgb '#000000' linewidth 1, "
            "$contours using ("
         << has_room("$1", x_ends, 0.08) << " && " << has_room("$2", y_ends, 0.06)
         << " ? $1 : NaN):2:(sprintf('%.5g', $3)) every " << labelled << "::" << labelled / 4
         << " with labels boxed font ',11'\n";
  return {"study-map", script.str(), width, height};
}

} // namespace rollwave
