#include "rollwave/study/study_plan.h"

#include <utility>

namespace rollwave {

namespace {

/// All combinations of one setting from each list, the last list varying fastest.
std::vector<std::vector<Setting>> combinations(const std::vector<std::vector<Setting>>& lists) {
  std::vector<std::vector<Setting>> all(1);
  for (const auto& list : lists) {
    std::vector<std::vector<Setting>> longer;
    for (const auto& combination : all)
      for (const Setting& setting : list) {
        longer.push_back(combination);
        longer.back().push_back(setting);
      }
    all = std::move(longer);
  }
  return all;
}

} // namespace

std::vector<RunPlan> plan_runs(const Parameters& parameters) {
  std::vector<NamedScene> scenes = parameters.study.scenes;
  if (scenes.empty())
    scenes.push_back({"", {}});
  std::vector<RunPlan> plans;
  for (const auto& scene : scenes)
    for (const auto& varied : combinations(parameters.study.vary)) {
      std::vector<Setting> settings = parameters.settings;
      settings.insert(settings.end(), scene.settings.begin(), scene.settings.end());
      settings.insert(settings.end(), varied.begin(), varied.end());
      plans.push_back({scene.name, varied, read_parameters(settings)});
    }
  return plans;
}

} // namespace rollwave
