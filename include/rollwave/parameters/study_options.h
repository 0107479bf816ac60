#pragma once

#include "rollwave/parameters/key.h"
#include "rollwave/parameters/output_options.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace rollwave {

template <typename Options>
class Section;

/// A scene of a study by its name, with the settings that make it.
struct NamedScene {
  std::string name;
  std::vector<Setting> settings;
};

/// The choices for a key, or for keys that vary together: one setting for each key.
using Variation = std::vector<std::vector<Setting>>;

/// The part of a study that one call makes: of its runs every count-th, beginning with this one.
struct StudyPart {
  unsigned int number = 1, count = 1; ///< 1 <= number <= count
};

/// Section `Study`.
struct StudyOptions {
  std::vector<NamedScene> scenes; ///< none: the scene of the file
  std::vector<Variation> vary;    ///< the study runs every combination
  std::vector<std::optional<unsigned int>> published_steps;
  bool true_errors = false;
  std::set<OutputFile> files_of_each_run;
};

/// The keys of the section.
void declare_study(Section<StudyOptions> keys);

/// Puts numbers in the place of expressions in the settings of all runs.
/// @throws BadInput for one that its key does not accept, or a key that a scene sets twice or that
///         varies as well
void convert_runs(StudyOptions& study);

} // namespace rollwave
