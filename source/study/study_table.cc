#include "rollwave/study/study_table.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/text.h"
#include "rollwave/output/screen_report.h"
#include "rollwave/study/study_plot.h"

#include <deal.II/base/table_handler.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <ostream>
#include <set>
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
bool has_certificate(const StudyRun& run) {
  return run.figure("certified_relative").has_value();
}
bool has_linear_iterations(const StudyRun& run) {
  return run.figure("linear_iterations").value_or(0) > 0;
}
bool has_failure(const StudyRun& run) {
  return !run.failure.empty();
}
bool has_scene(const StudyRun& run) {
  return !run.scene.empty();
}
bool has_errors(const StudyRun& run) {
  return run.figure("error_relative").has_value();
}

/// The scene and what was varied, as text.
std::string name_of(const StudyRun& run) {
  const std::string curve = run.curve();
  if (run.settings.empty())
    return curve;
  const Setting& last = run.settings.back();
  return curve + (curve.empty() ? "" : ", ") + last.key + " " + last.value;
}

std::string text_of(double value, int digits) {
  std::ostringstream text;
  text.precision(digits);
  text << value;
  return text.str();
}

/// A figure as text, "-" where there is none.
std::string text_of(const std::optional<double>& value, int digits) {
  return value ? text_of(*value, digits) : "-";
}

/// log(e / e') / log(h / h') for two runs of one curve, "-" where there is none.
std::string observed_order(const StudyRun& before, const StudyRun& run, const std::string& error) {
  if (!before.figure(error) || !run.figure(error) || before.curve() != run.curve() ||
      !run.is_of_meshes() || before.figure("dofs") == run.figure("dofs"))
    return "-";
  const double errors = *before.figure(error) / *run.figure(error);
  const double unknowns = *run.figure("dofs") / *before.figure("dofs");
  return text_of(2 * std::log(errors) / std::log(unknowns), 3);
}

TableHandler make_table(const std::vector<StudyRun>& runs) {
  TableHandler table;
  const bool with_errors = any(runs, has_errors);
  const bool with_scenes = any(runs, has_scene);
  const bool with_published = any(runs, has_published_steps);
  const bool with_iterations = any(runs, has_linear_iterations);
  const bool with_certificate = any(runs, has_certificate);
  const bool with_outcome = with_scenes || any(runs, has_failure);
  for (unsigned int i = 0; i < runs.size(); ++i) {
    const StudyRun& run = runs[i];
    if (with_scenes)
      table.add_value("scene", run.scene);
    for (const Setting& setting : run.settings)
      table.add_value(setting.key, setting.value);
    const auto add = [&](const std::string& column, const std::string& figure, int digits) {
      table.add_value(column, text_of(run.figure(figure), digits));
    };
    add("unknowns", "dofs", 9);
    add("steps", "contact_steps", 9);
    if (with_iterations)
      add("linear iterations", "linear_iterations", 9);
    if (with_published)
      table.add_value("published",
                      run.published_steps ? std::to_string(*run.published_steps) : "-");
    if (with_scenes) {
      add("F", "force", 9);
      add("J", "energy", 9);
      if (with_errors)
        add("energy norm", "error_relative", 3);
    } else if (with_errors) {
      const auto add_error = [&](const std::string& column, const std::string& figure) {
        add(column, figure, 3);
        table.add_value(column + " order",
                        i > 0 ? observed_order(runs[i - 1], run, figure) : std::string("-"));
      };
      add_error("energy norm", "error_relative");
      add_error("L2 norm", "error_l2_norm");
      add_error("pressure", "error_pressure");
      add_error("F", "error_force");
      add_error("J", "error_energy");
      add("half-width", "error_half_width", 3);
    } else {
      add("F", "force", 9);
      add("J", "energy", 9);
      add("half-width", "half_width", 9);
    }
    if (with_certificate) {
      add("certified", "certified_relative", 3);
      if (with_errors) {
        add("effectivity", "effectivity", 3);
        add("bound/error", "bound_over_error", 3);
      }
    }
    if (with_scenes) {
      add("residual", "residual", 2);
      add("round-off", "round_off", 2);
    }
    if (with_outcome)
      table.add_value("outcome", std::string(run.failure.empty() ? "solved" : "not solved"));
    add("seconds", "seconds", 3);
  }
  return table;
}

/// The slope of log(error) over log(h), h ~ unknowns^(-1/2), through @p runs by least squares.
double fitted_order(const std::vector<const StudyRun*>& runs) {
  double x_mean = 0, y_mean = 0, xx = 0, xy = 0;
  const auto x = [](const StudyRun& run) { return -std::log(*run.figure("dofs")) / 2; };
  const auto y = [](const StudyRun& run) { return std::log(*run.figure("error_relative")); };
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
    for (; next < runs.size() && runs[next].curve() == runs[first].curve(); ++next)
      if (has_errors(runs[next]) &&
          (curve.empty() || curve.back()->figure("dofs") != runs[next].figure("dofs")))
        curve.push_back(&runs[next]);
    if (curve.size() >= 4 && runs[first].is_of_meshes()) {
      curve.erase(curve.begin(), curve.end() - 4);
      const std::string name = runs[first].curve();
      out << "Order of the energy norm in h" << (name.empty() ? "" : ", ") << name << ": fitted "
          << text_of(fitted_order(curve), 3) << " over the last three refinements, expected "
          << text_of(curve.back()->figure("expected_order"), 3) << '\n';
    }
    first = next;
  }
}

/// The runs with the user's words in TeX.
std::vector<StudyRun> runs_in_tex(std::vector<StudyRun> runs) {
  for (StudyRun& run : runs) {
    run.scene = in_tex(run.scene);
    for (Setting& setting : run.settings)
      setting.value = in_tex(setting.value);
  }
  return runs;
}

std::optional<double> number_of(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return *end == '\0' ? std::optional(number) : std::nullopt;
}

} // namespace

void print_study(std::ostream& out, const std::vector<StudyRun>& runs) {
  std::set<std::string> references;
  for (const StudyRun& run : runs)
    if (has_errors(run))
      references.insert(run.reference);
  for (const std::string& reference : references)
    out << "Errors against " << reference << ": energy norm relative, the others absolute.\n";
  if (any(runs, has_certificate))
    out << "Certified: the guaranteed bound of the relative error in the energy norm of the "
           "feasible displacement.\n";
  print_table(out, make_table(runs));
  for (const StudyRun& run : runs)
    if (has_failure(run))
      out << "Not solved, " << name_of(run) << ": " << run.failure << '\n';
  for (const StudyRun& run : runs)
    if (!run.remarks.empty())
      out << "Note, " << name_of(run) << ": " << run.remarks << '\n';
  print_orders(out, runs);
}

WrittenFiles write_study(const std::filesystem::path& directory, const Parameters& parameters,
                         const std::vector<StudyRun>& runs) {
  WrittenFiles written;
  const auto add = [&](const std::string& name, const std::string& content) {
    write_file(directory / name, content);
    written.files.push_back(directory / name);
  };
  written.files.push_back(directory / "study.csv");
  written.files.push_back(directory / "parameters.prm");
  std::ostringstream table, tex;
  print_study(table, runs);
  add("study.txt", table.str());
  make_table(runs_in_tex(runs)).write_tex(tex, /*with_header=*/false);
  add("study.tex", tex.str());
  const auto is_solved = [](const StudyRun& run) { return run.is_solved(); };
  if (!parameters.wants(OutputFile::plot) || std::none_of(runs.begin(), runs.end(), is_solved))
    return written;

  const auto add_plot = [&](const std::string& name, const StudyPlot& plot) {
    if (const auto [svg, failure] = plot_study(runs, plot).take(); failure.empty())
      add(name, svg);
    else
      written.remarks.push_back(name + " was not drawn: " + failure);
  };
  const auto figure = [](const std::string& name) {
    return RunValue([name](const StudyRun& run) { return run.figure(name); });
  };
  const RunValue published = [](const StudyRun& run) {
    return run.published_steps ? std::optional<double>(*run.published_steps) : std::nullopt;
  };
  const RunValue varied = [](const StudyRun& run) {
    return run.settings.empty() ? std::nullopt : number_of(run.settings.back().value);
  };
  const RunValue steps = figure("contact_steps");
  if (std::all_of(runs.begin(), runs.end(), [&](const auto& run) { return varied(run); })) {
    const Setting& last = runs.front().settings.back();
    const bool is_of_scenes = last.section == "Cylinder" || last.section == "Road";
    add_plot("study.svg", {last.path(),
                           is_of_scenes ? "contact force F" : "contact steps",
                           varied,
                           is_of_scenes ? figure("force") : steps,
                           any(runs, has_published_steps) ? published : RunValue(),
                           false,
                           !is_of_scenes,
                           {}});
  }

  if (any(runs, has_errors)) {
    const RunValue error = figure("error_relative");
    const RunValue unknowns = figure("dofs");
    const std::string label = "relative error in the energy norm";
    std::set<double> orders;
    for (const StudyRun& run : runs)
      if (has_errors(run))
        orders.insert(*run.figure("expected_order"));
    std::vector<double> over_h(orders.begin(), orders.end()), over_unknowns;
    for (const double order : orders)
      over_unknowns.push_back(-order / 2);
    add_plot("study-h.svg", {"h", label, figure("h_max"), error, {}, true, true, over_h});
    add_plot("study-unknowns.svg",
             {"unknowns", label, unknowns, error, {}, true, true, over_unknowns});
    add_plot("study-time.svg", {"seconds", label, figure("seconds"), error, {}, true, true, {}});
    add_plot("study-steps.svg", {"unknowns", "contact steps", unknowns, steps, {}, true, true, {}});
    if (any(runs, has_linear_iterations))
      add_plot("study-iterations.svg", {"unknowns",
                                        "linear iterations",
                                        unknowns,
                                        figure("linear_iterations"),
                                        {},
                                        true,
                                        true,
                                        {}});
  }
  return written;
}

} // namespace rollwave
