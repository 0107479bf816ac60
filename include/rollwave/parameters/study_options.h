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
  std::vector<Assignment> settings;
};

/// The choices for a key, or for keys that vary together: one setting for each key.
using Variation = std::vector<std::vector<Assignment>>;

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

/// @throws RefusedSetting for a key that a scene sets twice or that varies as well
void check_scenes(const StudyOptions& study);

} // namespace rollwave
