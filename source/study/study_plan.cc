#include "rollwave/study/study_plan.h"

#include "rollwave/base/text.h"
#include "rollwave/base/version.h"
#include "rollwave/run/simulation.h"
#include "rollwave/scene/scene.h"
#include "rollwave/scene/units.h"

#include <boost/algorithm/string/erase.hpp>
#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace rollwave {

namespace {

/// @throws BadValue for a study whose plan alone would take long
void check_number_of_runs(const StudyOptions& study) {
  constexpr double most = 1e6;
  double n_runs = std::max<std::size_t>(study.scenes.size(), 1);
  for (const Variation& variation : study.vary)
    n_runs *= variation.size();
  if (n_runs > most)
    throw BadValue("Study", "Vary",
                   "the study would have " + rounded(n_runs, 15) + " runs, and " +
                       rounded(most, 15) + " are the most");
}

/// All combinations of one choice from each variation, the last varying fastest.
std::vector<std::vector<Assignment>> combinations(const std::vector<Variation>& variations) {
  std::vector<std::vector<Assignment>> all(1);
  for (const Variation& variation : variations) {
    std::vector<std::vector<Assignment>> longer;
    for (const auto& combination : all)
      for (const auto& choice : variation) {
        longer.push_back(combination);
        longer.back().insert(longer.back().end(), choice.begin(), choice.end());
      }
    all = std::move(longer);
  }
  return all;
}

/// What the runs of a study share: its parameters without those of section Study, and without the
/// place and the kinds of its own files.
Parameters shared_parameters(Parameters parameters) {
  parameters.study = {};
  auto& settings = parameters.settings;
  settings.erase(std::remove_if(settings.begin(), settings.end(),
                                [](const Setting& setting) {
                                  return setting.section == "Study" ||
                                         setting.path() == "Output/Directory" ||
                                         setting.path() == "Output/Files";
                                }),
                 settings.end());
  return parameters;
}

/// See RunPlan::digest. @param run its parameters
std::string digest_of(const Parameters& run, bool has_true_errors) {
  std::string text = has_true_errors ? "with true errors\n" : "\n";
  for (const Key& key : all_keys())
    if (key.section != "Study" && key.section != "Output")
      text += value_of(key, run.settings) + '\n';
  boost::algorithm::erase_all(text, " "); // which expressions may have anywhere
  return digest_with_program(text);
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

/// The numbers of a value with at most five digits, whole ones with all; other values as they are.
std::string shortened(const std::string& value) {
  try {
    std::vector<std::string> numbers;
    for (const std::string& text : split(value, ',')) {
      const double number = to_number(text);
      numbers.push_back(number == std::round(number) ? text : rounded(number, 5));
    }
    return boost::algorithm::join(numbers, ", ");
  } catch (const std::invalid_argument&) {
    return value;
  }
}

std::string lower_case_name(const Key& key) {
  std::string name = key.name;
  name[0] = std::tolower(name[0]);
  return name;
}

} // namespace

std::vector<RunPlan> plan_runs(const Parameters& parameters) {
  const StudyOptions& study = parameters.study;
  check_number_of_runs(study);
  const std::vector<NamedScene> single(1);
  const auto choices = combinations(study.vary);
  std::vector<RunPlan> plans;
  const Parameters shared = shared_parameters(parameters);
  for (const NamedScene& scene : study.scenes.empty() ? single : study.scenes) {
    const Parameters of_scene = with_values(shared, scene.settings);
    for (const std::vector<Assignment>& varied : choices) {
      const Parameters run = with_values(of_scene, varied);
      try {
        check_simulation(make_scene(run), run);
      } catch (const BadValue& value) {
        throw BadInput(refusal(run.settings, value));
      }
      plans.push_back({scene.name,
                       {scene.settings.begin(), scene.settings.end()},
                       {varied.begin(), varied.end()},
                       {},
                       run,
                       digest_of(run, study.true_errors)});
    }
  }
  check_method(plans);
  const auto& published = study.published_steps;
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
  return (key.symbol.empty() ? lower_case_name(key) + ' ' : key.symbol + " = ") +
         shortened(setting.value) + units.after(key.quantity);
}

std::string label(const RunPlan& plan, const std::vector<Setting>& named) {
  std::string text = plan.scene;
  for (const Setting& setting : named)
    text += (text.empty() ? "" : ", ") + key_with_value(setting, {1, plan.parameters.material});
  return text;
}

} // namespace rollwave
