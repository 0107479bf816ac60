#pragma once

#include "rollwave/run/result.h"
#include "rollwave/scene/units.h"
#include "rollwave/study/study_plan.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rollwave {

/// The outcome of one run of a study.
struct StudyRun {
  /// The known result_quantities() by their names, in the user's units; none where it was not
  /// solved.
  std::map<std::string, double> values;
  std::string reference; ///< what its errors are measured against; empty if there are none
  std::string failure;   ///< why it was not solved or did not reach its target; else empty
  std::vector<std::string> remarks;
  std::string shared; ///< what it reuses from the run before; its seconds leave that out
  std::string files;  ///< the directory of its own files; empty without
  std::vector<std::pair<double, double>> pressure; ///< angles and pressures along the contact

  bool is_solved() const { return !values.empty(); }
};

/// A study: its runs in their order, nullopt for those that have not ended.
struct Study {
  std::vector<RunPlan> plans;
  std::vector<std::optional<StudyRun>> runs;
  std::optional<StudyPart> part = {}; ///< where a call makes a part of the runs only

  /// The index in RunPlan::varied of the first key of each part of Study/Vary; the keys of a part
  /// vary together.
  std::vector<unsigned int> first_key_of_part = {};
  std::string shortfall = ""; ///< set if the user has interrupted it, otherwise empty

  /// The numbers of the runs that the call makes, from 0 on.
  std::vector<unsigned int> wanted_runs() const;

  std::size_t n_ended() const;

  /// The value of one of result_quantities() or of `published_steps`, where it is known.
  /// @throws std::out_of_range for another name
  std::optional<double> value(unsigned int run, const std::string& name) const;

  /// For the names of units: values are in the user's units already.
  Units units() const { return {1, plans.front().parameters.material}; }

  /// True if any run has a value that is greater than 0.
  bool has(const std::string& name) const;

  /// True if the runs differ in keys of the scene only, not in those of mesh or method.
  bool is_of_scenes() const;
};

/// The known quantities of a result by their names, in the user's units.
std::map<std::string, double> values_of(const Result& result, const Units& units);

/// The pressure from the node before contact to that after it, at about a hundred nodes at most,
/// in the user's units.
std::vector<std::pair<double, double>> pressure_of(const Result& result, const Units& units);

} // namespace rollwave
