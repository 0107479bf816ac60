#include "study_output.h"

#include "atomic_file.h"
#include "study_plot.h"

#include <deal.II/base/table_handler.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <ostream>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

bool any(const std::vector<StudyRun>& runs, bool (*has)(const StudyRun&)) {
  return std::any_of(runs.begin(), runs.end(), has);
}

bool has_published_steps(const StudyRun& run) {
  return run.published_steps.has_value();
}
bool has_errors(const StudyRun& run) {
  return run.result && run.result->errors;
}

struct ErrorColumn {
  const char* name;
  double TrueErrors::*member;
};

const ErrorColumn error_columns[] = {{"error_energy_norm", &TrueErrors::energy_norm},
                                     {"error_relative", &TrueErrors::relative_energy_norm},
                                     {"error_pressure", &TrueErrors::pressure},
                                     {"error_force", &TrueErrors::force},
                                     {"error_energy", &TrueErrors::energy},
                                     {"error_half_width", &TrueErrors::half_width}};

/// Full precision and one row for each run; the varied keys come first.
std::string study_csv(const std::vector<StudyRun>& runs) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  for (const Setting& setting : runs.front().settings)
    out << setting.path() << ',';
  out << "solved,degree,cells,dofs,h_max,contact_steps,published_steps,force,energy,half_width,"
         "peak_pressure";
  for (const ErrorColumn& column : error_columns)
    out << ',' << column.name;
  const char* const phases[] = {"mesh",          "space",   "assembly",          "ordering",
                                "factorisation", "contact", "back-substitution", "measurement"};
  for (const char* const phase : phases)
    out << ",seconds_" << phase;
  out << ",seconds,peak_memory_mib\n";

  for (const StudyRun& run : runs) {
    for (const Setting& setting : run.settings)
      out << setting.value << ',';
    const Result result = run.result.value_or(Result());
    // A run that was not solved leaves its fields empty.
    const auto field = [&](bool exists, auto value) {
      out << ',';
      if (exists)
        out << value;
    };
    const bool solved = run.result.has_value();
    out << solved;
    field(solved, result.mesh.degree);
    field(solved, result.mesh.cells);
    field(solved, result.mesh.dofs);
    field(solved, result.mesh.h_max);
    field(solved, result.history.size());
    field(run.published_steps.has_value(), run.published_steps.value_or(0));
    field(solved, result.patch.force);
    field(solved, result.energy.value);
    field(solved, result.patch.half_width());
    field(solved, result.patch.peak_pressure);
    for (const ErrorColumn& column : error_columns)
      field(result.errors.has_value(), result.errors.value_or(TrueErrors()).*column.member);
    for (const char* const phase : phases) {
      double seconds = 0;
      for (const auto& [name, own] : result.work.seconds())
        if (name == phase)
          seconds = own;
      field(solved, seconds);
    }
    field(solved, result.work.total_seconds());
    field(solved, run.peak_memory_mib);
    out << '\n';
  }
  return out.str();
}

std::string text_of(double value, int digits) {
  std::ostringstream text;
  text.precision(digits);
  text << value;
  return text.str();
}

/// log(e / e') / log(h / h') for two runs of one curve, "-" where there is none.
std::string observed_order(const StudyRun& before, const StudyRun& run,
                           double TrueErrors::*member) {
  if (!has_errors(before) || !has_errors(run) || curve_name(before) != curve_name(run) ||
      before.result->mesh.dofs == run.result->mesh.dofs)
    return "-";
  const double errors = (*before.result->errors).*member / ((*run.result->errors).*member);
  const double unknowns = static_cast<double>(run.result->mesh.dofs) / before.result->mesh.dofs;
  return text_of(2 * std::log(errors) / std::log(unknowns), 3);
}

TableHandler make_table(const std::vector<StudyRun>& runs) {
  TableHandler table;
  const bool with_errors = any(runs, has_errors);
  const bool with_published = any(runs, has_published_steps);
  for (unsigned int i = 0; i < runs.size(); ++i) {
    const StudyRun& run = runs[i];
    for (const Setting& setting : run.settings)
      table.add_value(setting.key, setting.value);
    const Result result = run.result.value_or(Result());
    const auto add = [&](const std::string& column, double value, int digits) {
      table.add_value(column, run.result ? text_of(value, digits) : "-");
    };
    add("unknowns", result.mesh.dofs, 9);
    add("steps", result.history.size(), 9);
    if (with_published)
      table.add_value("published",
                      run.published_steps ? std::to_string(*run.published_steps) : "-");
    if (!with_errors) {
      add("F", result.patch.force, 9);
      add("J", result.energy.value, 9);
      add("half-width", result.patch.half_width(), 9);
    } else {
      const auto add_error = [&](const std::string& column, double TrueErrors::*member) {
        table.add_value(column, has_errors(run) ? text_of((*result.errors).*member, 3) : "-");
        table.add_value(column + " order",
                        i > 0 ? observed_order(runs[i - 1], run, member) : std::string("-"));
      };
      add_error("energy norm", &TrueErrors::relative_energy_norm);
      add_error("pressure", &TrueErrors::pressure);
      add_error("F", &TrueErrors::force);
      add_error("J", &TrueErrors::energy);
      table.add_value("half-width", has_errors(run) ? text_of(result.errors->half_width, 3) : "-");
    }
    add("seconds", result.work.total_seconds(), 3);
  }
  return table;
}

/// The slope of log(error) over log(h), h ~ unknowns^(-1/2), through @p runs by least squares.
double fitted_order(const std::vector<const StudyRun*>& runs) {
  double x_mean = 0, y_mean = 0, xx = 0, xy = 0;
  const auto x = [](const StudyRun& run) { return -std::log(run.result->mesh.dofs) / 2; };
  const auto y = [](const StudyRun& run) {
    return std::log(run.result->errors->relative_energy_norm);
  };
  for (const StudyRun* const run : runs) {
    x_mean += x(*run) / runs.size();
    y_mean += y(*run) / runs.size();
  }
  for (const StudyRun* const run : runs) {
    xx += (x(*run) - x_mean) * (x(*run) - x_mean);
    xy += (x(*run) - x_mean) * (y(*run) - y_mean);
  }
  return xy / xx;
}

/// For each curve the order over its last four runs, three refinements, beside the expected one.
void print_orders(std::ostream& out, const std::vector<StudyRun>& runs) {
  for (unsigned int first = 0; first < runs.size();) {
    unsigned int next = first;
    std::vector<const StudyRun*> curve;
    for (; next < runs.size() && curve_name(runs[next]) == curve_name(runs[first]); ++next)
      if (has_errors(runs[next]) &&
          (curve.empty() || curve.back()->result->mesh.dofs != runs[next].result->mesh.dofs))
        curve.push_back(&runs[next]);
    if (curve.size() >= 4) {
      curve.erase(curve.begin(), curve.end() - 4);
      out << "Order of the energy norm in h, " << curve_name(runs[first]) << ": fitted "
          << text_of(fitted_order(curve), 3) << " over the last three refinements, expected "
          << text_of(curve.back()->result->errors->expected_order, 3) << '\n';
    }
    first = next;
  }
}

std::optional<double> number_of(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return *end == '\0' ? std::optional(number) : std::nullopt;
}

} // namespace

void print_study(std::ostream& out, const std::vector<StudyRun>& runs) {
  if (any(runs, has_errors))
    out << "Errors against the semi-analytic solution: energy norm relative, the others "
           "absolute.\n";
  make_table(runs).write_text(out, TableHandler::table_with_headers);
  print_orders(out, runs);
}

WrittenFiles write_study(const std::filesystem::path& directory, const Parameters& parameters,
                         const std::vector<StudyRun>& runs) {
  WrittenFiles written;
  const auto add = [&](const std::string& name, const std::string& content) {
    write_file(directory / name, content);
    written.files.push_back(directory / name);
  };
  add("study.csv", study_csv(runs));
  std::ostringstream table, tex;
  print_study(table, runs);
  add("study.txt", table.str());
  make_table(runs).write_tex(tex, /*with_header=*/false);
  add("study.tex", tex.str());
  if (parameters.wants(OutputFile::parameters)) {
    std::ostringstream text;
    write_parameters(text, parameters);
    add("parameters.prm", text.str());
  }
  if (!parameters.wants(OutputFile::plot))
    return written;

  const auto add_plot = [&](const std::string& name, const StudyPlot& plot) {
    if (const auto svg = plot_study(runs, plot))
      add(name, *svg);
    else
      written.remarks.push_back(name + " was not drawn: is gnuplot installed?");
  };
  const RunValue steps = [](const StudyRun& run) {
    return run.result ? std::optional<double>(run.result->history.size()) : std::nullopt;
  };
  const RunValue published = [](const StudyRun& run) {
    return run.published_steps ? std::optional<double>(*run.published_steps) : std::nullopt;
  };
  const RunValue varied = [](const StudyRun& run) { return number_of(run.settings.back().value); };
  if (std::all_of(runs.begin(), runs.end(), [&](const auto& run) { return varied(run); }))
    add_plot("study.svg", {runs.front().settings.back().path(),
                           "contact steps",
                           varied,
                           steps,
                           any(runs, has_published_steps) ? published : RunValue(),
                           false,
                           {}});

  if (any(runs, has_errors)) {
    const RunValue error = [](const StudyRun& run) {
      return has_errors(run) ? std::optional(run.result->errors->relative_energy_norm)
                             : std::nullopt;
    };
    const RunValue h = [](const StudyRun& run) {
      return run.result ? std::optional(run.result->mesh.h_max) : std::nullopt;
    };
    const RunValue unknowns = [](const StudyRun& run) {
      return run.result ? std::optional<double>(run.result->mesh.dofs) : std::nullopt;
    };
    const RunValue seconds = [](const StudyRun& run) {
      return run.result ? std::optional(run.result->work.total_seconds()) : std::nullopt;
    };
    const std::string label = "relative error in the energy norm";
    add_plot("study-h.svg", {"h", label, h, error, {}, true, {0.5, 1, 1.5}});
    add_plot("study-unknowns.svg", {"unknowns", label, unknowns, error, {}, true, {-0.5, -0.75}});
    add_plot("study-time.svg", {"seconds", label, seconds, error, {}, true, {}});
    add_plot("study-steps.svg", {"unknowns", "contact steps", unknowns, steps, {}, true, {}});
  }
  return written;
}

} // namespace rollwave
