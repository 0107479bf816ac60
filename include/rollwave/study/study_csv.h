#pragma once

#include "rollwave/study/study.h"

#include <string>

namespace rollwave {

/// The text of study.csv, a line for each run that has ended, with all digits of its values. The
/// columns: `scene` if Study/Scenes is given, the varied keys, `solved`, `published_steps`,
/// `reference`, `failure`, `remarks`, `files`, result_quantities(), `shared`, `run`
/// (RunPlan::digest).
std::string study_csv(const Study& study);

/// The text of study-profiles.csv: digest of the run, angle, length along the road and pressure at
/// each point of the profiles.
std::string profiles_csv(const Study& study);

} // namespace rollwave
