#include "rollwave/study/study_record.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

namespace rollwave {

namespace {

/// The columns of figures, in their order.
const std::vector<std::string>& figure_names() {
  static const std::vector<std::string> names = {"degree",
                                                 "cells",
                                                 "dofs",
                                                 "h_max",
                                                 "cycles",
                                                 "contact_steps",
                                                 "linear_iterations",
                                                 "force",
                                                 "energy",
                                                 "half_width",
                                                 "peak_pressure",
                                                 "left_end",
                                                 "right_end",
                                                 "vertical_load",
                                                 "work_conjugate_load",
                                                 "load_lower_bound",
                                                 "load_upper_bound",
                                                 "error_energy_norm",
                                                 "error_relative",
                                                 "error_l2_norm",
                                                 "error_pressure",
                                                 "error_force",
                                                 "error_energy",
                                                 "error_half_width",
                                                 "expected_order",
                                                 "error_feasible",
                                                 "certified_energy_norm",
                                                 "certified_relative",
                                                 "energy_lower_bound",
                                                 "energy_upper_bound",
                                                 "effectivity",
                                                 "bound_over_error",
                                                 "residual",
                                                 "round_off",
                                                 "seconds_mesh",
                                                 "seconds_space",
                                                 "seconds_assembly",
                                                 "seconds_ordering",
                                                 "seconds_factorisation",
                                                 "seconds_preconditioner",
                                                 "seconds_contact",
                                                 "seconds_back-substitution",
                                                 "seconds_measurement",
                                                 "seconds_indicator",
                                                 "seconds_certificate",
                                                 "seconds",
                                                 "peak_memory_mib"};
  return names;
}

/// The end of the header, which is the same for all studies.
std::string figure_header() {
  std::string header = "solved,published_steps,reference,failure";
  for (const std::string& name : figure_names())
    header += "," + name;
  return header + ",remarks";
}

/// Text as a field in quotes.
std::string quoted(std::string text) {
  std::replace(text.begin(), text.end(), '"', '\'');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return '"' + text + '"';
}

/// The text of the field in quotes that ends before @p end, which is moved to the comma before it;
/// nullopt without one.
std::optional<std::string> take_quoted(const std::string& line, std::size_t& end) {
  const auto quote = end > 1 && line[end - 1] == '"' ? line.rfind('"', end - 2) : std::string::npos;
  if (quote == std::string::npos || quote == 0)
    return {};
  const std::string text = line.substr(quote + 1, end - quote - 2);
  end = quote - 1;
  return text;
}

} // namespace

std::optional<double> StudyRun::figure(const std::string& name) const {
  const auto found = figures.find(name);
  return found == figures.end() ? std::nullopt : std::optional(found->second);
}

std::string StudyRun::curve() const {
  std::string text = scene;
  for (unsigned int i = 0; i + 1 < settings.size(); ++i)
    text += (text.empty() ? "" : ", ") + settings[i].key + " " + settings[i].value;
  return text;
}

std::map<std::string, double> figures_of(const Result& result) {
  std::map<std::string, double> figures = {
      {"degree", result.mesh.degree},
      {"cells", result.mesh.cells},
      {"dofs", result.mesh.dofs},
      {"h_max", result.mesh.h_max},
      {"cycles", result.cycles.size()},
      {"contact_steps", result.history.size()},
      {"linear_iterations", result.work.linear_iterations},
      {"force", result.patch.force},
      {"energy", result.energy.value},
      {"half_width", result.patch.half_width()},
      {"peak_pressure", result.patch.peak_pressure},
      {"vertical_load", result.patch.vertical_load},
      {"work_conjugate_load", result.patch.work_conjugate_load},
      {"residual", result.residuals.largest()},
      {"round_off", result.residuals.round_off},
      {"seconds", result.work.total_seconds()},
      {"peak_memory_mib", result.peak_memory_mib}};
  for (const auto& [phase, seconds] : result.work.seconds())
    figures["seconds_" + phase] = seconds;
  if (result.patch.ends) {
    figures["left_end"] = result.patch.ends->first;
    figures["right_end"] = result.patch.ends->second;
  }
  if (result.load_bounds) {
    figures["load_lower_bound"] = result.load_bounds->lower;
    figures["load_upper_bound"] = result.load_bounds->upper;
  }
  if (result.errors) {
    figures["error_energy_norm"] = result.errors->energy_norm;
    figures["error_relative"] = result.errors->relative_energy_norm;
    if (std::isfinite(result.errors->l2_norm))
      figures["error_l2_norm"] = result.errors->l2_norm;
    figures["error_pressure"] = result.errors->pressure;
    figures["error_force"] = result.errors->force;
    figures["error_energy"] = result.errors->energy;
    figures["error_half_width"] = result.errors->half_width;
    figures["expected_order"] = result.errors->expected_order;
    if (result.errors->admissible_energy_norm) {
      figures["error_feasible"] = *result.errors->admissible_energy_norm;
      if (result.errors->effectivity)
        figures["effectivity"] = *result.errors->effectivity;
      if (*result.errors->admissible_energy_norm > 0)
        figures["bound_over_error"] =
            result.certified->energy_norm / *result.errors->admissible_energy_norm;
    }
  }
  if (result.certified) {
    figures["certified_energy_norm"] = result.certified->energy_norm;
    figures["certified_relative"] = result.certified->relative;
    figures["energy_lower_bound"] = result.certified->lower_bound;
    figures["energy_upper_bound"] = result.certified->upper_bound;
  }
  return figures;
}

std::string study_csv(const std::vector<StudyRun>& runs) {
  if (runs.empty())
    return {};
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  if (!runs.front().scene.empty())
    out << "scene,";
  for (const Setting& setting : runs.front().settings)
    out << setting.path() << ',';
  out << figure_header() << '\n';
  for (const StudyRun& run : runs) {
    if (!run.scene.empty())
      out << '"' << run.scene << "\",";
    for (const Setting& setting : run.settings)
      out << (setting.value.find(',') == std::string::npos ? setting.value
                                                           : '"' + setting.value + '"')
          << ',';
    out << run.is_solved() << ',';
    if (run.published_steps)
      out << *run.published_steps;
    out << ',' << quoted(run.reference) << ',' << quoted(run.failure);
    for (const std::string& name : figure_names()) {
      out << ',';
      if (const auto figure = run.figure(name))
        out << *figure;
    }
    out << ',' << quoted(run.remarks) << '\n';
  }
  return out.str();
}

std::vector<StudyRun> read_study_csv(const std::string& text) {
  std::istringstream in(text);
  std::string line;
  std::vector<StudyRun> runs;
  std::getline(in, line);
  const std::string expected = figure_header();
  if (line.size() < expected.size() ||
      line.compare(line.size() - expected.size(), expected.size(), expected) != 0)
    return runs;
  while (std::getline(in, line) && !in.eof()) { // a row without its end may lack digits
    // From the end: figures have no commas, but the varied values before them may.
    StudyRun run;
    std::size_t end = line.size();
    const auto remarks = take_quoted(line, end);
    if (!remarks)
      return runs;
    run.remarks = *remarks;
    for (auto name = figure_names().rbegin(); name != figure_names().rend(); ++name) {
      const auto comma = end > 0 ? line.rfind(',', end - 1) : std::string::npos;
      if (comma == std::string::npos)
        return runs;
      const std::string field = line.substr(comma + 1, end - comma - 1);
      if (!field.empty())
        run.figures[*name] = std::strtod(field.c_str(), nullptr);
      end = comma;
    }
    for (std::string* const text : {&run.failure, &run.reference}) {
      const auto field = take_quoted(line, end);
      if (!field)
        return runs;
      *text = *field;
    }
    runs.push_back(std::move(run));
  }
  return runs;
}

} // namespace rollwave
