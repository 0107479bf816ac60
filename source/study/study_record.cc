#include "rollwave/study/study_record.h"

#include "rollwave/scene/units.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

namespace rollwave {

using Json = nlohmann::ordered_json;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double or_none(const std::optional<double>& value) {
  return value.value_or(none);
}

/// Phases of Work, as they follow each other.
constexpr const char* phases[] = {
    "mesh",          "space",          "assembly",    "ordering",
    "factorisation", "preconditioner", "contact",     "back-substitution",
    "measurement",   "indicator",      "certificate", "output"};

/// What the figures measure that are no mere numbers.
const std::map<Quantity, std::set<std::string>> measured = {
    {Quantity::length, {"h_max", "road_distance"}},
    {Quantity::angle, {"half_width", "left_end", "right_end", "error_half_width"}},
    {Quantity::force,
     {"force", "vertical_load", "work_conjugate_load", "load_lower_bound", "load_upper_bound",
      "error_force"}},
    {Quantity::stiffness,
     {"stiffness_force", "stiffness_vertical_load", "stiffness_work_conjugate_load"}},
    {Quantity::pressure, {"peak_pressure"}},
    {Quantity::area, {"error_l2_norm"}},
    {Quantity::energy, {"energy", "energy_lower_bound", "energy_upper_bound", "error_energy"}},
    {Quantity::energy_norm, {"error_energy_norm", "error_feasible", "certified_energy_norm"}}};

std::string column(const std::string& figure, const Units& units) {
  for (const auto& [quantity, figures] : measured)
    if (figures.count(figure) > 0)
      return figure + units.in_brackets(quantity);
  return figure;
}

/// A text as a field of a CSV file.
std::string csv_field(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  if (text.find_first_of(",\"") == std::string::npos)
    return text;
  std::string quoted;
  for (const char c : text)
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  return '"' + quoted + '"';
}

StudyRun run_of(const Json& json) {
  StudyRun run;
  for (const auto& [name, value] : json.at("figures").items())
    run.figures.emplace_back(name, value.is_null() ? none : value.get<double>());
  json.at("reference").get_to(run.reference);
  json.at("failure").get_to(run.failure);
  json.at("refused").get_to(run.is_refused);
  json.at("remarks").get_to(run.remarks);
  json.at("shared").get_to(run.shared);
  json.at("files").get_to(run.files);
  json.at("pressure").get_to(run.pressure);
  return run;
}

} // namespace

std::optional<double> StudyRun::figure(const std::string& name) const {
  for (const auto& [own_name, value] : figures)
    if (own_name == name && !std::isnan(value))
      return value;
  return {};
}

std::vector<std::pair<std::string, double>> figures_of(const Result& result) {
  const auto& [mesh, patch, errors, certified] =
      std::tie(result.mesh, result.patch, result.errors, result.certified);
  const auto& bounds = result.load_bounds;
  const double feasible = errors ? or_none(errors->admissible_energy_norm) : none;
  std::vector<std::pair<std::string, double>> figures = {
      {"degree", mesh.degree},
      {"cells", mesh.cells},
      {"dofs", mesh.dofs},
      {"h_max", mesh.h_max},
      {"cycles", result.cycles.size()},
      {"contact_steps", result.history.size()},
      {"linear_iterations", result.work.linear_iterations},
      {"road_distance", result.road_distance},
      {"force", patch.force},
      {"energy", result.energy.value},
      {"half_width", patch.patches.size() < 2 ? patch.half_width() : none},
      {"peak_pressure", patch.peak_pressure},
      {"left_end", patch.ends ? patch.ends->first : none},
      {"right_end", patch.ends ? patch.ends->second : none},
      {"vertical_load", patch.vertical_load},
      {"work_conjugate_load", patch.work_conjugate_load},
      {"load_lower_bound", bounds ? bounds->lower : none},
      {"load_upper_bound", bounds ? bounds->upper : none},
      {"error_energy_norm", errors ? errors->energy_norm : none},
      {"error_relative", errors ? errors->relative_energy_norm : none},
      {"error_l2_norm", errors ? errors->l2_norm : none},
      {"error_pressure", errors ? errors->pressure : none},
      {"error_force", errors ? errors->force : none},
      {"error_energy", errors ? errors->energy : none},
      {"error_half_width", errors ? errors->half_width : none},
      {"expected_order", errors ? errors->expected_order : none},
      {"error_feasible", feasible},
      {"certified_energy_norm", certified ? certified->energy_norm : none},
      {"certified_relative", certified ? certified->relative : none},
      {"energy_lower_bound", certified ? certified->lower_bound : none},
      {"energy_upper_bound", certified ? certified->upper_bound : none},
      {"effectivity", errors ? or_none(errors->effectivity) : none},
      {"bound_over_error",
       certified && std::isgreater(feasible, 0.) ? certified->energy_norm / feasible : none},
      {"residual", result.residuals.largest()},
      {"round_off", result.residuals.round_off},
      {"patches", patch.patches.size()},
      {"stiffness_force", patch.stiffness.total},
      {"stiffness_vertical_load", patch.stiffness.vertical},
      {"stiffness_work_conjugate_load", patch.stiffness.work_conjugate}};
  const auto& seconds = result.work.seconds();
  for (const char* const phase : phases) {
    const auto spent = std::find_if(seconds.begin(), seconds.end(),
                                    [&](const auto& entry) { return entry.first == phase; });
    figures.emplace_back(std::string("seconds_") + phase,
                         spent == seconds.end() ? none : spent->second);
  }
  figures.emplace_back("seconds", result.work.total_seconds());
  figures.emplace_back("peak_memory_mib", result.peak_memory_mib);
  for (auto& [name, value] : figures)
    if (std::isinf(value)) // no number in JSON either
      value = none;
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

std::string to_json(const RunPlan& plan, const StudyRun& run) {
  Json figures = Json::object();
  for (const auto& [name, value] : run.figures)
    figures[name] = std::isnan(value) ? Json() : Json(value);
  return Json{
      {"settings", plan.identity}, {"figures", figures},        {"reference", run.reference},
      {"failure", run.failure},    {"refused", run.is_refused}, {"remarks", run.remarks},
      {"shared", run.shared},      {"files", run.files},        {"pressure", run.pressure}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<std::pair<std::map<std::string, std::string>, StudyRun>>
read_study_runs(const std::string& text) {
  std::vector<std::pair<std::map<std::string, std::string>, StudyRun>> runs;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    try {
      const Json json = Json::parse(line);
      runs.emplace_back(json.at("settings").get<std::map<std::string, std::string>>(),
                        run_of(json));
    } catch (const Json::exception&) {
      // A line that is torn or of another kind.
    }
  return runs;
}

std::string study_csv(const Study& study) {
  const RunPlan& first = study.plans.front();
  const bool has_scenes = !first.scene.empty();
  std::vector<std::string> names;
  for (const auto& run : study.runs)
    if (run && names.empty())
      for (const auto& figure : run->figures)
        names.push_back(figure.first);

  std::ostringstream out;
  out << (has_scenes ? "scene," : "");
  for (const Setting& setting : first.varied)
    out << setting.path() << ',';
  out << "solved,published_steps,reference,failure,remarks,files";
  const Units units{1, first.parameters.material};
  for (const std::string& name : names)
    out << ',' << column(name, units);
  out << ",shared\n";
  for (unsigned int i = 0; i < study.plans.size(); ++i) {
    if (!study.runs[i])
      continue;
    const RunPlan& plan = study.plans[i];
    const StudyRun& run = *study.runs[i];
    std::string remarks;
    for (const std::string& remark : run.remarks)
      remarks += (remarks.empty() ? "" : " | ") + remark;
    if (has_scenes)
      out << csv_field(plan.scene) << ',';
    for (const Setting& setting : plan.varied)
      out << csv_field(setting.value) << ',';
    out << run.is_solved() << ','
        << (plan.published_steps ? std::to_string(*plan.published_steps) : "") << ','
        << csv_field(run.reference) << ',' << csv_field(run.failure) << ',' << csv_field(remarks)
        << ',' << run.files;
    for (const std::string& name : names) {
      const auto value = run.figure(name);
      out << ',' << (value ? shortest_text(*value) : "");
    }
    out << ',' << csv_field(run.shared) << '\n';
  }
  return out.str();
}

} // namespace rollwave
