#include "rollwave/study/study_plan.h"

#include "rollwave/run/simulation.h"
#include "rollwave/scene/scene.h"
#include "rollwave/scene/units.h"

#include <cctype>
#include <map>
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

void check(const Parameters& parameters, unsigned int n_processes) {
  try {
    make_scene(parameters);
    check_simulation(parameters, n_processes);
  } catch (const BadValue& value) {
    throw BadInput(refusal(parameters.settings, value));
  }
}

/// How a key is told of.
struct Words {
  std::string words, symbol;
  Quantity quantity = Quantity::number;
};

const std::map<std::string, Words> words_of_keys = {
    {"Cylinder/Inner radius", {"radius of the hub", "a", Quantity::length}},
    {"Cylinder/Outer radius", {"radius of the cylinder", "b", Quantity::length}},
    {"Cylinder/Angular velocity", {"angular velocity", "ω", Quantity::angular_velocity}},
    {"Cylinder/Radial force", {"radial force", "f"}},
    {"Material/Shear modulus", {"shear modulus", "μ", Quantity::pressure}},
    {"Material/Width", {"width", "w", Quantity::length}},
    {"Road/Distance", {"road distance", "c", Quantity::length}},
    {"Road/Load", {"load", "L", Quantity::force}},
    {"Road/Curvature", {"curvature of the road", "κ"}},
    {"Road/Contact zone", {"zone of contact", "[z0, z1]"}},
    {"Contact/Rho", {"step length", "ρ", Quantity::force_density}}};

} // namespace

std::vector<RunPlan> plan_runs(const Parameters& parameters, unsigned int n_processes) {
  std::vector<NamedScene> scenes = parameters.study.scenes;
  if (scenes.empty())
    scenes.push_back({"", {}});
  std::vector<Setting> common;
  for (const Setting& setting : parameters.settings)
    if (setting.section != "Study" && setting.path() != "Output/Directory" &&
        setting.path() != "Output/Files")
      common.push_back(setting);
  std::vector<RunPlan> plans;
  for (const auto& scene : scenes)
    for (const auto& varied : combinations(parameters.study.vary)) {
      std::vector<Setting> settings = common;
      settings.insert(settings.end(), scene.settings.begin(), scene.settings.end());
      settings.insert(settings.end(), varied.begin(), varied.end());
      plans.push_back({scene.name, varied, {}, read_parameters(settings)});
      check(plans.back().parameters, n_processes);
    }
  const auto& published = parameters.study.published_steps;
  if (!published.empty() && published.size() != plans.size())
    throw BadInput(refusal(parameters.settings, "Study", "Published steps",
                           "there are " + std::to_string(published.size()) + " entries for " +
                               std::to_string(plans.size()) + " runs"));
  for (unsigned int i = 0; i < published.size(); ++i)
    plans[i].published_steps = published[i];
  return plans;
}

std::string words(const Setting& setting, const Units& units) {
  const auto known = words_of_keys.find(setting.path());
  if (known != words_of_keys.end())
    return known->second.words + ' ' + known->second.symbol +
           units.in_brackets(known->second.quantity);
  std::string text = setting.key;
  text[0] = std::tolower(text[0]);
  return text;
}

std::string told(const Setting& setting, const Units& units) {
  const auto known = words_of_keys.find(setting.path());
  if (known == words_of_keys.end())
    return words(setting, units) + ' ' + setting.value;
  return known->second.symbol + " = " + setting.value + units.after(known->second.quantity);
}

std::string label(const RunPlan& plan, const std::function<bool(const Setting&)>& is_told) {
  std::string text = plan.scene;
  for (const Setting& setting : plan.varied)
    if (is_told(setting))
      text += (text.empty() ? "" : ", ") + told(setting, {1, plan.parameters.material});
  return text;
}

} // namespace rollwave
