#include "rollwave/study/study_record.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace rollwave {

namespace {

double or_none(const std::optional<double>& value) {
  return value.value_or(not_known);
}

/// Phases of Work, as they follow each other.
constexpr const char* phases[] = {
    "mesh",          "space",          "assembly",    "ordering",
    "factorisation", "preconditioner", "contact",     "back-substitution",
    "measurement",   "indicator",      "certificate", "output"};

void add_errors(const Result& result, std::vector<Figure>& figures) {
  const auto& [errors, certified, bounds] =
      std::tie(result.errors, result.certified, result.load_bounds);
  const double feasible = errors ? or_none(errors->admissible_energy_norm) : not_known;
  figures.insert(
      figures.end(),
      {{"load_lower_bound", bounds ? bounds->lower : not_known, Quantity::force},
       {"load_upper_bound", bounds ? bounds->upper : not_known, Quantity::force},
       {"error_energy_norm", errors ? errors->energy_norm : not_known, Quantity::energy_norm},
       {"error_relative", errors ? errors->relative_energy_norm : not_known},
       {"error_l2_norm", errors ? errors->l2_norm : not_known, Quantity::area},
       {"error_pressure", errors ? errors->pressure : not_known, Quantity::pressure_norm},
       {"error_force", errors ? errors->force : not_known, Quantity::force},
       {"error_energy", errors ? errors->energy : not_known, Quantity::energy},
       {"error_half_width", errors ? errors->half_width : not_known, Quantity::angle},
       {"expected_order", errors ? errors->expected_order : not_known},
       {"error_feasible", feasible, Quantity::energy_norm},
       {"certified_energy_norm", certified ? certified->energy_norm : not_known,
        Quantity::energy_norm},
       {"certified_relative", certified ? certified->relative : not_known},
       {"energy_lower_bound", certified ? certified->lower_bound : not_known, Quantity::energy},
       {"energy_upper_bound", certified ? certified->upper_bound : not_known, Quantity::energy},
       {"effectivity", errors ? or_none(errors->effectivity) : not_known},
       {"bound_over_error", certified && std::isgreater(feasible, 0.)
                                ? certified->energy_norm / feasible
                                : not_known}});
}

} // namespace

std::optional<double> StudyRun::figure(const std::string& name) const {
  for (const Figure& figure : figures)
    if (figure.name == name && !std::isnan(figure.value))
      return figure.value;
  return {};
}

bool Study::has(const std::string& name) const {
  for (unsigned int run = 0; run < runs.size(); ++run)
    if (figure(run, name).value_or(0) > 0)
      return true;
  return false;
}

std::vector<Figure> figures_of(const Result& result) {
  const auto& [mesh, patch] = std::tie(result.mesh, result.patch);
  double contact_length = 0; // of the road under all patches
  for (const ContactPatch& own : patch.patches)
    contact_length += own.length;
  std::vector<Figure> figures = {
      {"degree", mesh.degree},
      {"cells", mesh.cells},
      {"dofs", mesh.dofs},
      {"h_max", mesh.h_max, Quantity::length},
      {"cycles", result.cycles.size()},
      {"contact_steps", result.history.size()},
      {"linear_iterations", result.work.linear_iterations},
      {"road_distance", result.road_distance, Quantity::length},
      {"force", patch.force, Quantity::force},
      {"energy", result.energy.value, Quantity::energy},
      {"half_width", patch.patches.size() < 2 ? patch.half_width() : not_known, Quantity::angle},
      {"peak_pressure", patch.peak_pressure, Quantity::pressure},
      {"left_end", patch.ends ? patch.ends->first : not_known, Quantity::angle},
      {"right_end", patch.ends ? patch.ends->second : not_known, Quantity::angle},
      {"vertical_load", patch.vertical_load, Quantity::force},
      {"work_conjugate_load", patch.work_conjugate_load, Quantity::force}};
  add_errors(result, figures);
  figures.insert(
      figures.end(),
      {{"residual", result.residuals.largest()},
       {"round_off", result.residuals.round_off},
       {"patches", patch.patches.size()},
       {"contact_length", contact_length, Quantity::length},
       {"stiffness_force", patch.stiffness.total, Quantity::stiffness},
       {"stiffness_vertical_load", patch.stiffness.vertical, Quantity::stiffness},
       {"stiffness_work_conjugate_load", patch.stiffness.work_conjugate, Quantity::stiffness}});
  const auto& seconds = result.work.seconds();
  for (const char* const phase : phases) {
    const auto spent = std::find_if(seconds.begin(), seconds.end(),
                                    [&](const auto& entry) { return entry.first == phase; });
    figures.emplace_back(std::string("seconds_") + phase,
                         spent == seconds.end() ? not_known : spent->second);
  }
  figures.emplace_back("seconds", result.work.total_seconds());
  figures.emplace_back("peak_memory_mib", result.peak_memory_mib);
  for (Figure& figure : figures)
    if (std::isinf(figure.value))
      figure.value = not_known;
  return figures;
}

std::vector<std::pair<double, double>> pressure_of(const Result& result) {
  const auto& rows = result.contact_rows;
  const auto presses = [](const ContactRow& row) { return row.pressure > 0; };
  const auto first = std::find_if(rows.begin(), rows.end(), presses);
  const auto last = std::find_if(rows.rbegin(), rows.rend(), presses).base();
  std::vector<std::pair<double, double>> pressure;
  if (first == rows.end())
    return pressure;
  const std::ptrdiff_t begin = std::max<std::ptrdiff_t>(0, first - rows.begin() - 1),
                       end = std::min<std::ptrdiff_t>(rows.size(), last - rows.begin() + 1),
                       step = 1 + (end - begin) / 100;
  for (std::ptrdiff_t i = begin; i < end; ++i)
    if ((i - begin) % step == 0 || i + 1 == end)
      pressure.emplace_back(rows[i].angle, rows[i].pressure);
  return pressure;
}

} // namespace rollwave
