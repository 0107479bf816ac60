#include "rollwave/study/study_title.h"

#include "rollwave/adapt/marking.h"
#include "rollwave/parameters/key.h"
#include "rollwave/scene/units.h"

#include <algorithm>
#include <set>

namespace rollwave {

std::string study_title(const Study& study, const std::vector<Setting>& settings) {
  std::set<std::string> differing; // keys
  for (const RunPlan& plan : study.plans)
    for (const auto& of_run : {plan.scene_settings, plan.varied})
      for (const Setting& setting : of_run)
        differing.insert(setting.path());
  if (std::any_of(study.plans.begin(), study.plans.end(),
                  [](const RunPlan& plan) { return plan.parameters.road.calibrates(); }))
    differing.insert({"Material/Shear modulus", "Material/Density"}); // which are results
  const std::set<std::string> places = {"Road/Distance", "Road/Load", "Road/Nip"};
  for (const std::string& key : places) // of which one or two are none
    if (differing.count(key) > 0) {
      differing.insert(places.begin(), places.end());
      break;
    }
  std::string title;
  for (const Key& key : all_keys()) {
    const Setting setting{key.section, key.name, value_of(key, settings), ""};
    const bool is_named = (key.affects & Affects::titles) ||
                          ((key.affects & Affects::scene) && setting.value != key.default_value);
    if (is_named && differing.count(key.path()) == 0 && setting.value != "none")
      title += (title.empty() ? "" : ", ") + key_with_value(setting, study.units());
  }
  const bool all_are_adaptive =
      std::all_of(study.plans.begin(), study.plans.end(),
                  [](const RunPlan& plan) { return is_adaptive(plan.parameters.mesh); });
  return title + (all_are_adaptive ? ", adaptive" : "");
}

} // namespace rollwave
