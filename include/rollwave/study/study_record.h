#ifndef ROLLWAVE_STUDY_STUDY_RECORD_H
#define ROLLWAVE_STUDY_STUDY_RECORD_H

#include "rollwave/run/result.h"
#include "rollwave/scene/units.h"
#include "rollwave/study/study_plan.h"

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rollwave {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// A number that a run has found, by its name in study.csv; not_known where there is none.
struct Figure {
  template <typename Number>
  Figure(std::string name, Number value, Quantity quantity = Quantity::number)
      : name(std::move(name)), value(value), quantity(quantity) {}

  std::string name;
  double value;
  Quantity quantity;
};

/// The outcome of one run of a study.
struct StudyRun {
  std::vector<Figure> figures; ///< none where it was not solved
  std::string reference;       ///< what its errors are measured against; empty without errors
  std::string failure; ///< why it was not solved, or not to what was wanted; empty where it was
  std::vector<std::string> remarks;
  std::string shared; ///< what it has from the run before, which its seconds do not count
  std::string files;  ///< the directory of its own files; empty without
  std::vector<std::pair<double, double>> pressure; ///< angles and pressures along the contact

  bool is_solved() const { return !figures.empty(); }
  std::optional<double> figure(const std::string& name) const;
};

/// A study: its runs in their order, nullopt for those that have not ended.
struct Study {
  std::vector<RunPlan> plans;
  std::vector<std::optional<StudyRun>> runs;
  bool has_true_errors = false; ///< true if they were asked for

  /// The places in RunPlan::varied at which the keys of each part of Study/Vary begin; those of a
  /// part move together.
  std::vector<unsigned int> first_keys = {};
  std::string shortfall = ""; ///< where the user has interrupted it; mostly empty

  std::optional<double> figure(unsigned int run, const std::string& name) const {
    if (name == "published_steps")
      return plans[run].published_steps;
    return runs[run] ? runs[run]->figure(name) : std::nullopt;
  }

  /// For the names of units: figures are in the user's units already.
  Units units() const { return {1, plans.front().parameters.material}; }

  /// True if any run has a figure that is greater than 0.
  bool has(const std::string& name) const;
};

/// The figures of a solved scene with its peak memory, seconds last.
std::vector<Figure> figures_of(const Result& result);

/// The pressure from the node before contact to that behind it, at about a hundred nodes at most.
std::vector<std::pair<double, double>> pressure_of(const Result& result);

} // namespace rollwave

#endif
