#ifndef ROLLWAVE_STUDY_STUDY_PLOT_H
#define ROLLWAVE_STUDY_STUDY_PLOT_H

#include "rollwave/output/gnuplot.h"
#include "rollwave/study/study_record.h"

#include <functional>
#include <optional>
#include <string>

namespace rollwave {

/// What a run contributes to a plot; nullopt leaves a gap.
using RunValue = std::function<std::optional<double>(const StudyRun&)>;

struct StudyPlot {
  std::string x_label;
  std::string y_label;
  RunValue x;
  RunValue y;
  RunValue marks; ///< further values shown as open circles; may be empty
  bool log_x;
  bool log_y;
  std::vector<double> slopes; ///< expected powers of x, drawn as dashed lines
};

/// One curve for each choice of all keys but the one that varies fastest.
Drawing plot_study(const std::vector<StudyRun>& runs, const StudyPlot& plot);

} // namespace rollwave

#endif
