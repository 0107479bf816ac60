#include "rollwave/study/study_plot.h"

#include "rollwave/base/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <sstream>

namespace rollwave {

namespace {

/// Colours of curves; with dashes and points they can be distinguished in print as well.
const std::vector<std::string> colours = {"#0072b2", "#d55e00", "#009e73",
                                          "#cc79a7", "#000000", "#e69f00"};

/// With all digits that a picture can show.
std::string plotted(double number) {
  return std::isnan(number) ? "NaN" : rounded(number, 9);
}

/// @p text with at most four decimal digits in its numbers, as legends have room for.
std::string with_short_numbers(std::string text) {
  static const std::regex long_number(R"(\d+\.\d{5,}(e[+-]?\d+)?)");
  std::string shortened;
  for (std::smatch number; std::regex_search(text, number, long_number); text = number.suffix())
    shortened += number.prefix().str() + rounded(std::stod(number.str()), 5);
  return shortened + text;
}

/// The size of the letters of a title that leaves room for all of it.
unsigned int title_size(const std::string& title, unsigned int width) {
  constexpr unsigned int largest = 12, smallest = 7;
  constexpr double width_over_size = 0.62; // of a letter, as of most fonts without serifs
  return std::clamp<unsigned int>(width / (width_over_size * with_short_numbers(title).size()),
                                  smallest, largest);
}

/// As inline data, one block for each '-' of a command.
void write_points(std::ostream& data, const Points& points) {
  for (const auto& [x, y] : points)
    data << plotted(x) << ' ' << plotted(y) << '\n';
  data << "e\n";
}

/// c of the line y = c x^slope, below all points.
double below(const std::vector<Curve>& curves, double slope) {
  double least = std::numeric_limits<double>::max();
  for (const Curve& curve : curves)
    for (const auto& [x, y] : curve.points)
      if (!std::isnan(y) && x > 0 && y > 0)
        least = std::min(least, y / std::pow(x, slope));
  return least / 2;
}

/// The style of the line of a curve.
std::string style(unsigned int curve, std::size_t n_points) {
  return "linespoints pointsize 0.6 pointinterval " + std::to_string(1 + n_points / 40) +
         " dashtype " + std::to_string(1 + curve % 4) + " pointtype " +
         std::to_string(7 - 2 * (curve / 4 % 3));
}

/// True if all points have whole numbers in x that fit as labels of an axis, such as numbers of
/// refinements.
bool has_few_integers(const Panel& panel) {
  constexpr double most = 12;
  for (const Curve& curve : panel.curves)
    for (const auto& [x, y] : curve.points)
      if (x != std::round(x) || std::abs(x) > most)
        return false;
  return true;
}

/// The command that plots a panel, with its data. @param legend_rows of the legend of all panels; 0
/// for none
void plot(std::ostream& script, const Panel& panel, unsigned int legend_rows) {
  script << "set xlabel " << in_single_quotes(panel.x_label) << "\nset ylabel "
         << in_single_quotes(panel.y_label);
  if (legend_rows > 0)
    script << "\nset key at screen 0.5, 0.01 center bottom vertical maxrows " << legend_rows;
  else
    script << "\nunset key";
  // Offsets are lengths on the axis, which would lead a logarithmic one below zero.
  script << (panel.has_log_x ? "\nset logscale x\nset offsets 0, 0, 0, 0\n"
                             : "\nunset logscale x\nset offsets graph 0.03, graph 0.03, 0, 0\n"
                               "set autoscale xfix\n")
         << (!panel.has_log_x && has_few_integers(panel) ? "set xtics 1\n" : "set xtics autofreq\n")
         << (panel.has_log_y ? "set" : "unset") << " logscale y\nset format '%g'\n";
  if (panel.has_log_y && !panel.has_log_x) // numbers of steps, which seldom span decades
    script << "set ytics (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 1e4, 1e5, 1e6)\n";
  script << "plot ";
  std::ostringstream data;
  auto add = [&, is_first = true](const Points& points, unsigned int curve,
                                  const std::string& style, const std::string& title) mutable {
    script << (is_first ? "" : ", ") << "'-' with " << style << " linewidth 2 linecolor rgb '"
           << colours[curve] << "' title " << in_single_quotes(with_short_numbers(title));
    write_points(data, points);
    is_first = false;
  };
  for (unsigned int i = 0; i < panel.curves.size(); ++i) {
    const Curve& curve = panel.curves[i];
    add(curve.points, i, style(i, curve.points.size()), curve.title);
    if (!curve.marks.empty())
      add(curve.marks, i, "points pointtype 6 pointsize 1.4", curve.title + " published");
  }
  for (unsigned int i = 0; i < panel.slopes.size(); ++i)
    script << ", " << below(panel.curves, panel.slopes[i]) << " * x**(" << panel.slopes[i]
           << ") with lines linewidth 1.5 linecolor rgb '#808080' dashtype " << 3 + i
           << " title 'expected slope " << panel.slopes[i] << "'";
  script << '\n' << data.str();
}

} // namespace

std::vector<unsigned int> equidistant_numbers(unsigned int n, unsigned int most) {
  const unsigned int n_chosen = std::min(n, most);
  std::vector<unsigned int> chosen;
  for (unsigned int i = 0; i < n_chosen; ++i)
    chosen.push_back(n_chosen == 1 ? 0 : i * (n - 1) / (n_chosen - 1));
  return chosen;
}

Picture plot_panels(std::string title, std::vector<Panel> panels) {
  if (const std::size_t n_curves = panels.front().curves.size(); n_curves > most_curves)
    title += "; " + std::to_string(most_curves) + " of " + std::to_string(n_curves) + " curves";
  for (Panel& panel : panels) {
    std::vector<Curve> chosen;
    for (const unsigned int i : equidistant_numbers(panel.curves.size(), most_curves))
      chosen.push_back(panel.curves[i]);
    panel.curves = std::move(chosen);
  }
  std::ostringstream script;
  script.precision(9);
  script << "set grid\nset datafile missing 'NaN'\n";
  const bool is_single = panels.size() == 1;
  unsigned int n_titles = panels[0].slopes.size(),
               longest = n_titles > 0 ? std::string("expected slope -0.75").size() : 0;
  for (const Curve& curve : panels[0].curves) {
    n_titles += curve.marks.empty() ? 1 : 2;
    longest = std::max<unsigned int>(longest, curve.title.size() + (curve.marks.empty() ? 0 : 10));
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
         << in_single_quotes(with_short_numbers(title)) << " font '," << title_size(title, width)
         << "' margins " << (is_single ? 0.14 : 0.11) << ",0.96,"
         << (70. + 20 * legend_rows) / height << ',' << 1 - 45. / height << " spacing 0.13,"
         << 80. / height << '\n';
  for (unsigned int k = 0; k < panels.size(); ++k)
    plot(script, panels[k], k == 0 ? legend_rows : 0);
  script << "unset multiplot\n";
  return {script.str(), width, height};
}

Picture plot_map(const std::string& title, const std::string& x_label, const std::string& y_label,
                 const std::string& value_label,
                 const std::vector<std::vector<std::array<double, 3>>>& lines) {
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
         << in_single_quotes(with_short_numbers(title)) << " font '," << title_size(title, 760)
         << "'\nset xlabel " << in_single_quotes(x_label) << "\nset ylabel "
         << in_single_quotes(y_label) << "\nset cblabel " << in_single_quotes(value_label)
         << "\nset pm3d interpolate 8,8\n"
            "splot $map with pm3d, $contours with lines linecolor rgb '#000000' linewidth 1, "
            "$contours using 1:2:3:(sprintf('%.3g', $3)) every ::4::4 with labels boxed "
            "font ',10'\n";
  return {script.str(), 760, 560};
}

} // namespace rollwave
