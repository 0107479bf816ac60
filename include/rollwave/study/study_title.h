#pragma once

#include "rollwave/study/study.h"

#include <string>
#include <vector>

namespace rollwave {

/// The values that all runs share: of the keys that titles name, and of others of the scene that
/// are not at their defaults.
/// @param settings that the user gave
std::string study_title(const Study& study, const std::vector<Setting>& settings);

} // namespace rollwave
