#include "rollwave/study/study_csv.h"

#include "rollwave/base/text.h"
#include "rollwave/run/quantities.h"
#include "rollwave/scene/units.h"

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/replace.hpp>

#include <algorithm>

namespace rollwave {

namespace {

/// @p text as a field of a line of CSV (RFC 4180): in quotation marks where it needs them, with
/// blanks for ends of lines.
std::string csv_field(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  if (text.find_first_of(",\"") == std::string::npos)
    return text;
  return '"' + boost::algorithm::replace_all_copy(text, "\"", "\"\"") + '"';
}

std::string header(const Study& study) {
  const RunPlan& plan = study.plans.front();
  std::string line = plan.scene.empty() ? "" : "scene,";
  for (const Setting& setting : plan.varied)
    line += setting.path() + ',';
  line += "solved,published_steps,reference,failure,remarks,files";
  for (const ResultQuantity& quantity : result_quantities())
    line += ',' + quantity.name + study.units().in_brackets(quantity.quantity);
  return line + ",shared,run\n";
}

std::string row(const RunPlan& plan, const RunRecord& run, bool has_files) {
  std::string line = plan.scene.empty() ? "" : csv_field(plan.scene) + ',';
  for (const Setting& setting : plan.varied)
    line += csv_field(setting.value) + ',';
  line += run.is_solved() ? "1," : "0,";
  line += plan.published_steps ? std::to_string(*plan.published_steps) : "";
  const std::string remarks =
                        boost::algorithm::join(texts_of(run.notes, Note::Kind::remark), " | "),
                    files =
                        has_files && run.is_solved() ? directory_of_run(plan.digest).string() : "";
  for (const std::string& text : {run.reference, shortfall_text(run.notes), remarks, files})
    line += ',' + csv_field(text);
  for (const ResultQuantity& quantity : result_quantities()) {
    const auto value = run.values.find(quantity.name);
    line += ',' + (value != run.values.end() ? shortest_text(value->second) : "");
  }
  return line + ',' + csv_field(run.shared) + ',' + plan.digest + '\n';
}

} // namespace

std::string study_csv(const Study& study) {
  std::string text = header(study);
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    if (study.runs[run])
      text += row(study.plans[run], *study.runs[run], !study.files.kinds.empty());
  return text;
}

std::string profiles_csv(const Study& study) {
  const Units units = study.units();
  std::string text = "run,z" + units.in_brackets(Quantity::angle) + ",road_length" +
                     units.in_brackets(Quantity::length) + ",pressure" +
                     units.in_brackets(Quantity::pressure) + '\n';
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    if (study.runs[run])
      for (const ProfilePoint& point : study.runs[run]->profile)
        text += study.plans[run].digest + ',' + shortest_text(point.angle) + ',' +
                shortest_text(point.road_length) + ',' + shortest_text(point.pressure) + '\n';
  return text;
}

} // namespace rollwave
