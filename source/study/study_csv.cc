#include "rollwave/study/study_csv.h"

#include "rollwave/base/text.h"
#include "rollwave/run/quantities.h"
#include "rollwave/scene/units.h"

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <sstream>

namespace rollwave {

namespace {

std::string csv_field(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  if (text.find_first_of(",\"") == std::string::npos)
    return text;
  return '"' + boost::algorithm::replace_all_copy(text, "\"", "\"\"") + '"';
}

std::vector<std::string> csv_fields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  char before = ',';
  for (const char c : line) {
    if (c == '"') {
      is_quoted = !is_quoted;
      if (is_quoted && before == '"') // a doubled one
        fields.back() += c;
    } else if (c == ',' && !is_quoted)
      fields.emplace_back();
    else
      fields.back() += c;
    before = c;
  }
  return fields;
}

/// The fields by which runs differ, at the beginning of a line.
std::string key_fields(const RunPlan& plan) {
  std::string fields = plan.scene.empty() ? "" : csv_field(plan.scene) + ',';
  for (const Setting& setting : plan.varied)
    fields += csv_field(setting.value) + ',';
  return fields;
}

/// The run of the fields after those by which runs differ.
StudyRun read_run(const std::vector<std::string>& fields, std::size_t n_key_fields) {
  StudyRun run;
  auto field = fields.begin() + n_key_fields + 2; // after solved and published_steps
  run.reference = *field++;
  run.failure = *field++;
  run.remarks = split(*field++, '|');
  run.files = *field++;
  for (const ResultQuantity& quantity : result_quantities()) {
    if (!field->empty())
      run.values[quantity.name] = std::strtod(field->c_str(), nullptr);
    ++field;
  }
  run.shared = *field;
  return run;
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
  return line + ",shared\n";
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
    const auto value = study.value(number, quantity.name);
    line += ',' + (value ? shortest_text(*value) : "");
  }
  return line + ',' + csv_field(run.shared) + '\n';
}

void read_csv(const std::string& text, Study& study) {
  const std::string header = csv_header(study);
  if (text.rfind(header, 0) != 0)
    return;
  std::set<std::string> lines;
  std::istringstream in(text.substr(0, text.rfind('\n') + 1));
  for (std::string line; std::getline(in, line);)
    lines.insert(line);
  for (unsigned int i = 0; i < study.plans.size(); ++i) {
    const std::string start = key_fields(study.plans[i]);
    const auto line = lines.lower_bound(start + "1,"); // solved
    if (line == lines.end() || line->rfind(start + "1,", 0) != 0)
      continue;
    const auto fields = csv_fields(*line);
    if (fields.size() == csv_fields(header).size())
      study.runs[i] = read_run(fields, csv_fields(start).size() - 1);
  }
}

std::string profiles_header(const Study& study) {
  return "run,z" + study.units().in_brackets(Quantity::angle) + ",pressure" +
         study.units().in_brackets(Quantity::pressure) + '\n';
}

std::string profile_rows(const Study& study, unsigned int run) {
  std::string rows;
  for (const auto& [z, pressure] : study.runs[run]->pressure)
    rows += std::to_string(run + 1) + ',' + shortest_text(z) + ',' + shortest_text(pressure) + '\n';
  return rows;
}

void read_profiles(const std::string& text, Study& study) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    unsigned int run = 0;
    double z = 0, pressure = 0;
    if (std::sscanf(line.c_str(), "%u,%lf,%lf", &run, &z, &pressure) == 3 && run > 0 &&
        run <= study.runs.size() && study.runs[run - 1])
      study.runs[run - 1]->pressure.emplace_back(z, pressure);
  }
}

} // namespace rollwave
