#pragma once

#include "rollwave/scene/units.h"
#include "rollwave/study/run_record.h"
#include "rollwave/study/study_plan.h"

#include <optional>
#include <string>
#include <vector>

namespace rollwave {

/// A study: its runs in their order, nullopt for those that are not known and have not failed.
struct Study {
  std::vector<RunPlan> plans;
  std::vector<std::optional<RunRecord>> runs;
  OwnFiles files = {};                ///< wanted of each run
  std::optional<StudyPart> part = {}; ///< where a call makes a part of the runs only

  /// The index in RunPlan::varied of the first key of each part of Study/Vary; the keys of a part
  /// vary together.
  std::vector<unsigned int> first_key_of_part = {};
  unsigned int n_fastest = 1; ///< runs that follow each other and differ in the last part only
  std::string shortfall = ""; ///< set if the user has interrupted it, otherwise empty

  /// The numbers of the runs that the call makes, from 0 on.
  std::vector<unsigned int> wanted_runs() const;

  std::size_t n_ended() const;

  /// The value of one of result_quantities() or of `published_steps`, where it is known.
  std::optional<double> value(unsigned int run, const std::string& name) const;

  /// For the names of units: values are in the user's units already.
  Units units() const { return {1, plans.front().parameters.material}; }

  /// True if the value of any run is known.
  bool has(const std::string& name) const;

  /// True if the runs differ in keys of the scene only, not in those of mesh or method.
  bool is_of_scenes() const;
};

} // namespace rollwave
