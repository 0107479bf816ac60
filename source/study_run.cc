#include "study_run.h"

#include "memory.h"

#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

namespace rollwave {

namespace {

/// The columns of figures, in their order.
const std::vector<std::string>& figure_names() {
  static const std::vector<std::string> names = {"degree",
                                                 "cells",
                                                 "dofs",
                                                 "h_max",
                                                 "contact_steps",
                                                 "force",
                                                 "energy",
                                                 "half_width",
                                                 "peak_pressure",
                                                 "error_energy_norm",
                                                 "error_relative",
                                                 "error_pressure",
                                                 "error_force",
                                                 "error_energy",
                                                 "error_half_width",
                                                 "expected_order",
                                                 "seconds_mesh",
                                                 "seconds_space",
                                                 "seconds_assembly",
                                                 "seconds_ordering",
                                                 "seconds_factorisation",
                                                 "seconds_contact",
                                                 "seconds_back-substitution",
                                                 "seconds_measurement",
                                                 "seconds",
                                                 "peak_memory_mib",
                                                 "error_l2_norm"};
  return names;
}

/// The end of the header, which is the same for all studies.
std::string figure_header() {
  std::string header = "solved,published_steps";
  for (const std::string& name : figure_names())
    header += "," + name;
  return header;
}

} // namespace

std::optional<double> StudyRun::figure(const std::string& name) const {
  const auto found = figures.find(name);
  return found == figures.end() ? std::nullopt : std::optional(found->second);
}

std::string StudyRun::curve() const {
  std::string text;
  for (unsigned int i = 0; i + 1 < settings.size(); ++i)
    text += (i > 0 ? ", " : "") + settings[i].key + " " + settings[i].value;
  return text;
}

std::map<std::string, double> figures_of(const Result& result) {
  std::map<std::string, double> figures = {{"degree", result.mesh.degree},
                                           {"cells", result.mesh.cells},
                                           {"dofs", result.mesh.dofs},
                                           {"h_max", result.mesh.h_max},
                                           {"contact_steps", result.history.size()},
                                           {"force", result.patch.force},
                                           {"energy", result.energy.value},
                                           {"half_width", result.patch.half_width()},
                                           {"peak_pressure", result.patch.peak_pressure},
                                           {"seconds", result.work.total_seconds()},
                                           {"peak_memory_mib", peak_memory_mib()}};
  for (const auto& [phase, seconds] : result.work.seconds())
    figures["seconds_" + phase] = seconds;
  if (result.errors) {
    figures["error_energy_norm"] = result.errors->energy_norm;
    figures["error_relative"] = result.errors->relative_energy_norm;
    figures["error_l2_norm"] = result.errors->l2_norm;
    figures["error_pressure"] = result.errors->pressure;
    figures["error_force"] = result.errors->force;
    figures["error_energy"] = result.errors->energy;
    figures["error_half_width"] = result.errors->half_width;
    figures["expected_order"] = result.errors->expected_order;
  }
  return figures;
}

std::string study_csv(const std::vector<StudyRun>& runs) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  for (const Setting& setting : runs.front().settings)
    out << setting.path() << ',';
  out << figure_header() << '\n';
  for (const StudyRun& run : runs) {
    for (const Setting& setting : run.settings)
      out << (setting.value.find(',') == std::string::npos ? setting.value
                                                           : '"' + setting.value + '"')
          << ',';
    out << run.is_solved() << ',';
    if (run.published_steps)
      out << *run.published_steps;
    for (const std::string& name : figure_names()) {
      out << ',';
      if (const auto figure = run.figure(name))
        out << *figure;
    }
    out << '\n';
  }
  return out.str();
}

std::vector<std::map<std::string, double>> read_study_csv(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::vector<std::map<std::string, double>> rows;
  std::getline(in, line);
  const std::string expected = figure_header();
  if (line.size() < expected.size() ||
      line.compare(line.size() - expected.size(), expected.size(), expected) != 0)
    return rows;
  while (std::getline(in, line)) {
    // Figures are the last fields, and have no commas; the varied values before them may.
    std::vector<std::string> fields;
    std::size_t end = line.size();
    for (unsigned int i = 0; i < figure_names().size(); ++i) {
      const auto comma = line.rfind(',', end - 1);
      fields.insert(fields.begin(), line.substr(comma + 1, end - comma - 1));
      end = comma;
    }
    rows.emplace_back();
    for (unsigned int i = 0; i < fields.size(); ++i)
      if (!fields[i].empty())
        rows.back()[figure_names()[i]] = std::strtod(fields[i].c_str(), nullptr);
  }
  return rows;
}

} // namespace rollwave
