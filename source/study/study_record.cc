#include "rollwave/study/study_record.h"

#include "rollwave/base/text.h"
#include "rollwave/scene/units.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <tuple>

namespace rollwave {

static constexpr double none = std::numeric_limits<double>::quiet_NaN();

// These three are called by the library, which finds them by their names.
static void to_json(nlohmann::json& json, const Figure& figure) {
  json = {figure.name, figure.value, figure.quantity}; // what is not a number becomes null
}
static void from_json(const nlohmann::json& json, Figure& figure) {
  const nlohmann::json& value = json.at(1);
  figure = Figure(json.at(0).get<std::string>(), value.is_null() ? none : value.get<double>(),
                  json.at(2).get<Quantity>());
}
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StudyRun, figures, reference, failure, is_refused, remarks,
                                   shared, files, pressure)

namespace {

double or_none(const std::optional<double>& value) {
  return value.value_or(none);
}

/// Phases of Work, as they follow each other.
constexpr const char* phases[] = {
    "mesh",          "space",          "assembly",    "ordering",
    "factorisation", "preconditioner", "contact",     "back-substitution",
    "measurement",   "indicator",      "certificate", "output"};

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

void add_errors(const Result& result, std::vector<Figure>& figures) {
  const auto& [errors, certified, bounds] =
      std::tie(result.errors, result.certified, result.load_bounds);
  const double feasible = errors ? or_none(errors->admissible_energy_norm) : none;
  figures.insert(
      figures.end(),
      {{"load_lower_bound", bounds ? bounds->lower : none, Quantity::force},
       {"load_upper_bound", bounds ? bounds->upper : none, Quantity::force},
       {"error_energy_norm", errors ? errors->energy_norm : none, Quantity::energy_norm},
       {"error_relative", errors ? errors->relative_energy_norm : none},
       {"error_l2_norm", errors ? errors->l2_norm : none, Quantity::area},
       {"error_pressure", errors ? errors->pressure : none, Quantity::pressure_norm},
       {"error_force", errors ? errors->force : none, Quantity::force},
       {"error_energy", errors ? errors->energy : none, Quantity::energy},
       {"error_half_width", errors ? errors->half_width : none, Quantity::angle},
       {"expected_order", errors ? errors->expected_order : none},
       {"error_feasible", feasible, Quantity::energy_norm},
       {"certified_energy_norm", certified ? certified->energy_norm : none, Quantity::energy_norm},
       {"certified_relative", certified ? certified->relative : none},
       {"energy_lower_bound", certified ? certified->lower_bound : none, Quantity::energy},
       {"energy_upper_bound", certified ? certified->upper_bound : none, Quantity::energy},
       {"effectivity", errors ? or_none(errors->effectivity) : none},
       {"bound_over_error",
        certified && std::isgreater(feasible, 0.) ? certified->energy_norm / feasible : none}});
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
      {"half_width", patch.patches.size() < 2 ? patch.half_width() : none, Quantity::angle},
      {"peak_pressure", patch.peak_pressure, Quantity::pressure},
      {"left_end", patch.ends ? patch.ends->first : none, Quantity::angle},
      {"right_end", patch.ends ? patch.ends->second : none, Quantity::angle},
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
                         spent == seconds.end() ? none : spent->second);
  }
  figures.emplace_back("seconds", result.work.total_seconds());
  figures.emplace_back("peak_memory_mib", result.peak_memory_mib);
  for (Figure& figure : figures)
    if (std::isinf(figure.value)) // no number in JSON either
      figure.value = none;
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

std::string study_line(const RunPlan& plan, const StudyRun& run) {
  nlohmann::json json = run;
  json["settings"] = plan.identity;
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::vector<std::pair<std::map<std::string, std::string>, StudyRun>>
read_study_runs(const std::string& text) {
  std::vector<std::pair<std::map<std::string, std::string>, StudyRun>> runs;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    try {
      const nlohmann::json json = nlohmann::json::parse(line);
      runs.emplace_back(json.at("settings"), json.get<StudyRun>());
    } catch (const nlohmann::json::exception&) {
      // A line that is torn or of another kind.
    }
  return runs;
}

std::string study_csv(const Study& study) {
  const RunPlan& first = study.plans.front();
  const bool has_scenes = !first.scene.empty();
  std::vector<Figure> columns;
  for (const auto& run : study.runs)
    if (run && columns.empty())
      columns = run->figures;

  std::ostringstream out;
  out << (has_scenes ? "scene," : "");
  for (const Setting& setting : first.varied)
    out << setting.path() << ',';
  out << "solved,published_steps,reference,failure,remarks,files";
  const Units units{1, first.parameters.material};
  for (const Figure& figure : columns)
    out << ',' << figure.name << units.in_brackets(figure.quantity);
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
    for (const Figure& figure : columns) {
      const auto value = run.figure(figure.name);
      out << ',' << (value ? shortest_text(*value) : "");
    }
    out << ',' << csv_field(run.shared) << '\n';
  }
  return out.str();
}

} // namespace rollwave
