#ifndef ROLLWAVE_STUDY_STUDY_RECORD_H
#define ROLLWAVE_STUDY_STUDY_RECORD_H

#include "rollwave/parameters/parameters.h"
#include "rollwave/run/result.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rollwave {

/// One run of a study: the settings in which it differs from the others, and its figures by name,
/// as in the columns of study.csv. A run that was not solved has none.
struct StudyRun {
  std::string scene; ///< its name in Study/Scenes, empty without
  std::vector<Setting> settings;
  std::optional<unsigned int> published_steps;
  std::map<std::string, double> figures;
  std::string reference; ///< what its errors are measured against; empty without errors
  std::string failure;   ///< why it was not solved, or not to what was wanted; empty where it was
  std::string remarks;   ///< those of its Result, with " | " between them

  bool is_solved() const { return !figures.empty(); }

  /// Whether runs of the curve differ in their meshes.
  bool is_of_meshes() const { return !settings.empty() && settings.back().section == "Mesh"; }
  std::optional<double> figure(const std::string& name) const;

  /// The scene and the settings but the one that varies fastest, as text: runs that share it make a
  /// curve.
  std::string curve() const;
};

/// The figures of a solved scene, and its peak memory.
std::map<std::string, double> figures_of(const Result& result);

/// study.csv: `scene` where there are several, the varied keys, `solved`, `published_steps`,
/// `reference`, `failure`, the figures in full precision, `remarks`.
std::string study_csv(const std::vector<StudyRun>& runs);

/// The runs that study_csv() wrote, without their settings and published steps; none where it
/// has other columns, and none from the first row on that lacks fields or its end.
std::vector<StudyRun> read_study_csv(const std::string& text);

} // namespace rollwave

#endif
