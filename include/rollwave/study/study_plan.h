#pragma once

#include "rollwave/parameters/parameters.h"
#include "rollwave/scene/units.h"

#include <optional>
#include <string>
#include <vector>

namespace rollwave {

/// A run of a study before it is made.
struct RunPlan {
  std::string scene;                   ///< its name in Study/Scenes, empty without
  std::vector<Setting> scene_settings; ///< those of this scene
  std::vector<Setting> varied;         ///< one setting for each key of Study/Vary
  std::optional<unsigned int> published_steps;
  Parameters parameters; ///< of this run alone, without those of section Study

  /// A digest of the parameters of this run as the program holds them, without those of Output; of
  /// `True errors`, which adds to its results; and of the program, see digest_with_program().
  std::string digest;
};

/// Every combination of the values in `Study/Vary`, the last key varying fastest, for each of
/// `Study/Scenes` where there are some.
/// @throws BadInput when any setting is refused, or `Study/Published steps` does not have one entry
///         for each run
std::vector<RunPlan> plan_runs(const Parameters& parameters);

/// The label of an axis: a key with its symbol and unit, such as "distance c [m]".
std::string axis_label(const Setting& setting, const Units& units);

/// A key with its value, such as "c = 0.8 m" or "degree 2".
std::string key_with_value(const Setting& setting, const Units& units);

/// The scene of a plan and some of its settings as text: "c = 0.8, degree 2".
std::string label(const RunPlan& plan, const std::vector<Setting>& named);

} // namespace rollwave
