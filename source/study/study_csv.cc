#include "rollwave/study/study_csv.h"

#include "rollwave/base/csv.h"
#include "rollwave/base/text.h"
#include "rollwave/run/quantities.h"
#include "rollwave/scene/units.h"

#include <boost/algorithm/string/join.hpp>

#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <system_error>
#include <unordered_map>

namespace rollwave {

namespace {

/// The fields by which runs differ, at the beginning of a line.
std::string key_fields(const RunPlan& plan) {
  std::string fields = plan.scene.empty() ? "" : csv_field(plan.scene) + ',';
  for (const Setting& setting : plan.varied)
    fields += csv_field(setting.value) + ',';
  return fields;
}

/// The finite number that is all of a field.
std::optional<double> read_number(const std::string& field) {
  double number = 0;
  const char* const end = field.data() + field.size();
  const auto [rest, error] = std::from_chars(field.data(), end, number);
  const bool is_number = error == std::errc() && rest == end && std::isfinite(number);
  return is_number ? std::optional(number) : std::nullopt;
}

/// The numbers of the runs with each digest, among those that are wanted.
std::unordered_map<std::string, std::vector<unsigned int>> runs_by_digest(const Study& study) {
  std::unordered_map<std::string, std::vector<unsigned int>> runs;
  for (const unsigned int run : study.wanted_runs())
    runs[study.plans[run].digest].push_back(run);
  return runs;
}

/// The solved run of a line; nullopt if it has none, or a field that cannot be read. The varied
/// keys, of which another study has others, come first: the other fields are counted from the end.
std::optional<StudyRun> read_run(const std::string& line) {
  const auto fields = csv_fields(line);
  const auto& quantities = result_quantities();
  const std::size_t n_others = 8; // solved, published_steps, ..., files; shared, run
  if (fields.size() < quantities.size() + n_others)
    return {};
  auto field = fields.end() - (quantities.size() + n_others);
  if (*field != "1")
    return {};
  field += 2; // after solved and published_steps
  StudyRun run;
  run.reference = *field++;
  run.failure = *field++;
  run.remarks = split(*field++, '|');
  run.files = *field++;
  for (const ResultQuantity& quantity : quantities) {
    if (!field->empty()) {
      const auto value = read_number(*field);
      if (!value)
        return {};
      run.values[quantity.name] = *value;
    }
    ++field;
  }
  run.shared = *field;
  return run.is_solved() ? std::optional(run) : std::nullopt;
}

} // namespace

std::string csv_header(const Study& study) {
  const RunPlan& plan = study.plans.front();
  std::string line = plan.scene.empty() ? "" : "scene,";
  for (const Setting& setting : plan.varied)
    line += setting.path() + ',';
  line += "solved,published_steps,reference,failure,remarks,files";
  for (const ResultQuantity& quantity : result_quantities())
    line += ',' + quantity.name + study.units().in_brackets(quantity.quantity);
  return line + ",shared,run\n";
}

std::string csv_row(const Study& study, unsigned int number) {
  const RunPlan& plan = study.plans[number];
  const StudyRun& run = *study.runs[number];
  const std::string remarks = boost::algorithm::join(run.remarks, " | ");
  std::string line = key_fields(plan) + (run.is_solved() ? "1," : "0,") +
                     (plan.published_steps ? std::to_string(*plan.published_steps) : "");
  for (const std::string& text : {run.reference, run.failure, remarks, run.files})
    line += ',' + csv_field(text);
  for (const ResultQuantity& quantity : result_quantities()) {
    const auto value = run.values.find(quantity.name);
    line += ',' + (value != run.values.end() ? shortest_text(value->second) : "");
  }
  return line + ',' + csv_field(run.shared) + ',' + plan.digest + '\n';
}

void read_csv(const std::string& text, Study& study) {
  const auto runs_of = runs_by_digest(study);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (const auto runs = runs_of.find(trimmed(line.substr(line.rfind(',') + 1)));
        runs != runs_of.end())
      if (const auto row = read_run(line))
        for (const unsigned int run : runs->second)
          study.runs[run] = row;
}

std::string profiles_header(const Study& study) {
  return "run,z" + study.units().in_brackets(Quantity::angle) + ",pressure" +
         study.units().in_brackets(Quantity::pressure) + '\n';
}

std::string profile_rows(const Study& study, unsigned int run) {
  std::string rows;
  for (const auto& [z, pressure] : study.runs[run]->pressure)
    rows += study.plans[run].digest + ',' + shortest_text(z) + ',' + shortest_text(pressure) + '\n';
  return rows;
}

void read_profiles(const std::string& text, Study& study) {
  const auto runs_of = runs_by_digest(study);
  std::unordered_map<std::string, std::map<double, double>> profiles;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto fields = csv_fields(line);
    if (fields.size() != 3 || runs_of.count(fields[0]) == 0)
      continue;
    const auto z = read_number(fields[1]), pressure = read_number(trimmed(fields[2]));
    if (z && pressure)
      profiles[fields[0]][*z] = *pressure;
  }
  for (const auto& [digest, profile] : profiles)
    for (const unsigned int run : runs_of.at(digest))
      if (auto& row = study.runs[run])
        row->pressure.assign(profile.begin(), profile.end());
}

} // namespace rollwave
