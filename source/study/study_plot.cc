#include "rollwave/study/study_plot.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace rollwave {

namespace {

std::string number_or_nan(const std::optional<double>& value) {
  std::ostringstream text;
  text.precision(9);
  if (value)
    text << *value;
  else
    text << "NaN";
  return text.str();
}

/// For gnuplot, between single quotes.
std::string text_for_gnuplot(const std::string& text) {
  std::string doubled;
  for (const char letter : text)
    doubled += letter == '\'' ? "''" : std::string(1, letter);
  return doubled;
}

} // namespace

Drawing plot_study(const std::vector<StudyRun>& runs, const StudyPlot& plot) {
  std::ostringstream script;
  std::vector<std::string> curves;
  double x_low = 0, x_high = 0, y_high = 0;
  for (const StudyRun& run : runs) {
    if (curves.empty() || curves.back() != run.curve()) {
      script << (curves.empty() ? "" : "EOD\n") << "$curve" << curves.size() << " << EOD\n";
      curves.push_back(run.curve());
    }
    const auto x = plot.x(run), y = plot.y(run);
    if (x && y) {
      x_low = x_high == 0 ? *x : std::min(x_low, *x);
      x_high = std::max(x_high, *x);
      y_high = std::max(y_high, *y);
    }
    script << number_or_nan(x) << ' ' << number_or_nan(y) << ' '
           << number_or_nan(plot.marks ? plot.marks(run) : std::nullopt) << '\n';
  }
  script << "EOD\nset datafile missing 'NaN'\nset grid\nset key below height 1\n"
         << (plot.log_y ? "set logscale y\n" : "")
         << (plot.log_x ? "set logscale x\nset format x '%.0e'\n" : "") << "set format y '%g'\n"
         << "set offsets graph 0.03, graph 0.03, 0, 0\nset xlabel '" << plot.x_label
         << "'\nset ylabel '" << plot.y_label << "'\nplot ";
  for (unsigned int i = 0; i < curves.size(); ++i) {
    script << (i > 0 ? ", " : "") << "$curve" << i << " using 1:2 with linespoints linewidth 2 "
           << "linetype " << i + 1 << " pointtype 7 pointsize 0.6 title '"
           << text_for_gnuplot(curves[i]) << "'";
    if (plot.marks)
      script << ", $curve" << i << " using 1:3 with points linetype " << i + 1
             << " pointtype 6 pointsize 1.4 linewidth 2 title '" << text_for_gnuplot(curves[i])
             << " published'";
  }
  // Beside the curves, which begin where they are highest.
  for (unsigned int i = 0; i < plot.slopes.size(); ++i)
    script << ", [" << x_low << ':' << x_high << "] " << y_high / 2 << " * (x / "
           << (plot.slopes[i] < 0 ? x_low : x_high) << ")**(" << plot.slopes[i]
           << ") with lines dashtype " << i + 2 << " linecolor rgb '#808080' title 'slope "
           << plot.slopes[i] << "'";
  script << '\n';
  return Drawing(script.str(), 760, 560);
}

} // namespace rollwave
