#include "rollwave/study/study.h"

#include <algorithm>

namespace rollwave {

std::vector<unsigned int> Study::wanted_runs() const {
  const StudyPart wanted = part.value_or(StudyPart());
  std::vector<unsigned int> numbers;
  for (unsigned int run = wanted.number - 1; run < plans.size(); run += wanted.count)
    numbers.push_back(run);
  return numbers;
}

std::size_t Study::n_ended() const {
  return runs.size() - std::count(runs.begin(), runs.end(), std::nullopt);
}

std::optional<double> Study::value(unsigned int run, const std::string& name) const {
  if (name == "published_steps")
    return plans[run].published_steps;
  if (runs[run])
    if (const auto known = runs[run]->values.find(name); known != runs[run]->values.end())
      return known->second;
  return {};
}

bool Study::has(const std::string& name) const {
  for (unsigned int run = 0; run < runs.size(); ++run)
    if (value(run, name))
      return true;
  return false;
}

bool Study::is_of_scenes() const {
  const auto are_of_scene = [](const std::vector<Setting>& settings) {
    return std::all_of(settings.begin(), settings.end(), [](const Setting& setting) {
      return key_of(setting).affects & Affects::scene;
    });
  };
  return std::all_of(plans.begin(), plans.end(), [&](const RunPlan& plan) {
    return are_of_scene(plan.varied) && are_of_scene(plan.scene_settings);
  });
}

} // namespace rollwave
