#include "rollwave/study/study_plan.h"

#include "rollwave/run/simulation.h"
#include "rollwave/scene/scene.h"
#include "rollwave/scene/units.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace rollwave {

namespace {

/// All combinations of one choice from each variation, the last varying fastest.
std::vector<std::vector<Setting>> combinations(const std::vector<Variation>& variations) {
  std::vector<std::vector<Setting>> all(1);
  for (const Variation& variation : variations) {
    std::vector<std::vector<Setting>> longer;
    for (const auto& combination : all)
      for (const auto& choice : variation) {
        longer.push_back(combination);
        longer.back().insert(longer.back().end(), choice.begin(), choice.end());
      }
    all = std::move(longer);
  }
  return all;
}

void check(const Parameters& parameters) {
  try {
    check_simulation(make_scene(parameters), parameters);
  } catch (const BadValue& value) {
    throw BadInput(refusal(parameters.settings, value));
  }
}

/// The settings that the runs of a study share.
std::vector<Setting> common_settings(const Parameters& study) {
  std::vector<Setting> common;
  for (const Setting& setting : study.settings)
    if (setting.section != "Study" && setting.path() != "Output/Directory" &&
        setting.path() != "Output/Files")
      common.push_back(setting);
  return common;
}

/// Refuses a varied key that belongs to Uzawa's method where no run uses that.
void check_method(const std::vector<RunPlan>& plans) {
  const bool has_uzawa = std::any_of(plans.begin(), plans.end(), [](const RunPlan& plan) {
    return plan.parameters.contact.method == ContactMethod::uzawa;
  });
  for (const Setting& setting : plans.front().varied)
    if (!has_uzawa && (key_of(setting).affects & Affects::uzawa))
      throw BadValue("Study", "Vary",
                     setting.path() + " has no effect without Contact/Method = uzawa");
}

std::string lower_case_name(const Key& key) {
  std::string name = key.name;
  name[0] = std::tolower(name[0]);
  return name;
}

} // namespace

std::vector<RunPlan> plan_runs(const Parameters& parameters) {
  std::vector<NamedScene> scenes = parameters.study.scenes;
  if (scenes.empty())
    scenes.push_back({"", {}});
  const std::vector<Setting> common = common_settings(parameters);
  std::vector<RunPlan> plans;
  for (const auto& scene : scenes)
    for (const auto& varied : combinations(parameters.study.vary)) {
      std::vector<Setting> settings = common;
      settings.insert(settings.end(), scene.settings.begin(), scene.settings.end());
      settings.insert(settings.end(), varied.begin(), varied.end());
      plans.push_back({scene.name, varied, {}, read_parameters(settings)});
      check(plans.back().parameters);
    }
  check_method(plans);
  const auto& published = parameters.study.published_steps;
  if (!published.empty() && published.size() != plans.size())
    throw BadValue("Study", "Published steps",
                   "there are " + std::to_string(published.size()) + " entries for " +
                       std::to_string(plans.size()) + " runs");
  for (unsigned int i = 0; i < published.size(); ++i)
    plans[i].published_steps = published[i];
  return plans;
}

std::string axis_label(const Setting& setting, const Units& units) {
  const Key& key = key_of(setting);
  return lower_case_name(key) + (key.symbol.empty() ? "" : ' ' + key.symbol) +
         units.in_brackets(key.quantity);
}

std::string key_with_value(const Setting& setting, const Units& units) {
  const Key& key = key_of(setting);
  return (key.symbol.empty() ? lower_case_name(key) + ' ' : key.symbol + " = ") + setting.value +
         units.after(key.quantity);
}

std::string label(const RunPlan& plan, const std::function<bool(const Setting&)>& is_named) {
  std::string text = plan.scene;
  for (const Setting& setting : plan.varied)
    if (is_named(setting))
      text += (text.empty() ? "" : ", ") + key_with_value(setting, {1, plan.parameters.material});
  return text;
}

} // namespace rollwave
