#include "atomic_file.h"
#include "gnuplot.h"
#include "study.h"

#include <deal.II/base/table_handler.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

/// Full precision and one row for each run; the varied keys come first.
std::string study_csv(const std::vector<StudyRun>& runs) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  for (const Setting& setting : runs.front().settings)
    out << setting.path() << ',';
  out << "solved,degree,cells,dofs,h_max,contact_steps,published_steps,force,energy,half_width,"
         "peak_pressure,seconds\n";
  for (const StudyRun& run : runs) {
    for (const Setting& setting : run.settings)
      out << setting.value << ',';
    const std::string published =
        run.published_steps ? std::to_string(*run.published_steps) : std::string();
    if (!run.result) {
      out << "0,,,,,," << published << ",,,,,\n";
      continue;
    }
    const Result& result = *run.result;
    out << "1," << result.mesh.degree << ',' << result.mesh.cells << ',' << result.mesh.dofs << ','
        << result.mesh.h_max << ',' << result.history.size() << ',' << published << ','
        << result.patch.force << ',' << result.energy.value << ',' << result.patch.half_width()
        << ',' << result.patch.peak_pressure << ',' << result.work.total_seconds() << '\n';
  }
  return out.str();
}

/// Curves of contact steps over the key that varies fastest, one for each choice of the others.
std::string steps_plot(const std::vector<StudyRun>& runs) {
  const auto label = [](const StudyRun& run) {
    std::string text;
    for (unsigned int i = 0; i + 1 < run.settings.size(); ++i)
      text += (i > 0 ? ", " : "") + run.settings[i].key + " " + run.settings[i].value;
    return text;
  };
  std::ostringstream script;
  std::vector<std::string> labels;
  for (const StudyRun& run : runs) {
    if (labels.empty() || labels.back() != label(run)) {
      script << (labels.empty() ? "" : "EOD\n") << "$curve" << labels.size() << " << EOD\n";
      labels.push_back(label(run));
    }
    script << run.settings.back().value << ' '
           << (run.result ? std::to_string(run.result->history.size()) : "NaN") << ' '
           << (run.published_steps ? std::to_string(*run.published_steps) : "NaN") << '\n';
  }
  script << "EOD\nset datafile missing 'NaN'\nset grid\nset key top center\nset logscale y\n"
         << "set offsets graph 0.03, graph 0.03, 0, 0\nset xlabel '"
         << runs.front().settings.back().path() << "'\nset ylabel 'contact steps'\nplot ";
  const bool has_published = std::any_of(runs.begin(), runs.end(), [](const StudyRun& run) {
    return run.published_steps.has_value();
  });
  for (unsigned int i = 0; i < labels.size(); ++i) {
    script << (i > 0 ? ", " : "") << "$curve" << i << " using 1:2 with linespoints linewidth 2 "
           << "linetype " << i + 1 << " pointtype 7 pointsize 0.6 title '" << labels[i] << "'";
    if (has_published)
      script << ", $curve" << i << " using 1:3 with points linetype " << i + 1
             << " pointtype 6 pointsize 1.4 linewidth 2 title '" << labels[i] << " published'";
  }
  script << '\n';
  return script.str();
}

} // namespace

std::string study_table(const std::vector<StudyRun>& runs) {
  TableHandler table;
  const bool has_published = std::any_of(runs.begin(), runs.end(), [](const StudyRun& run) {
    return run.published_steps.has_value();
  });
  for (const StudyRun& run : runs) {
    for (const Setting& setting : run.settings)
      table.add_value(setting.path(), setting.value);
    const auto add = [&](const std::string& column, auto value) {
      std::ostringstream text;
      text.precision(9);
      text << value;
      table.add_value(column, run.result ? text.str() : "-");
    };
    const Result result = run.result.value_or(Result());
    add("dofs", result.mesh.dofs);
    add("contact steps", result.history.size());
    if (has_published)
      table.add_value("published",
                      run.published_steps ? std::to_string(*run.published_steps) : "-");
    add("F", result.patch.force);
    add("J", result.energy.value);
    add("half-width", result.patch.half_width());
  }
  std::ostringstream out;
  table.write_text(out, TableHandler::table_with_headers);
  return out.str();
}

WrittenFiles write_study(const std::filesystem::path& directory, const Parameters& parameters,
                         const std::vector<StudyRun>& runs) {
  WrittenFiles written;
  const auto add = [&](const std::string& name, const std::string& content) {
    write_file(directory / name, content);
    written.files.push_back(directory / name);
  };
  add("study.csv", study_csv(runs));
  add("study.txt", study_table(runs));
  if (parameters.wants(OutputFile::parameters)) {
    std::ostringstream text;
    write_parameters(text, parameters);
    add("parameters.prm", text.str());
  }
  if (parameters.wants(OutputFile::plot)) {
    if (const auto svg = draw_svg(steps_plot(runs), 760, 520))
      add("study.svg", *svg);
    else
      written.remarks.push_back("study.svg was not drawn: is gnuplot installed, and are the values "
                                "of the last key in Study/Vary numbers?");
  }
  return written;
}

} // namespace rollwave
