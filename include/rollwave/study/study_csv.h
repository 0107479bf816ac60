#pragma once

#include "rollwave/study/study_record.h"

#include <string>

namespace rollwave {

/// The first line of study.csv: `scene` if Study/Scenes is given, the varied keys, `solved`,
/// `published_steps`, `reference`, `failure`, `remarks`, `files`, result_quantities(), `shared`,
/// `run` (RunPlan::digest).
std::string csv_header(const Study& study);

/// The line of a run that has ended, with all digits of its values.
std::string csv_row(const Study& study, unsigned int run);

/// Takes over the rows of wanted runs that are solved from the text of any study.csv: a row belongs
/// to each run with its digest. A row of which a field cannot be read is left out.
void read_csv(const std::string& text, Study& study);

/// The first line of study-profiles.csv.
std::string profiles_header(const Study& study);

/// Its lines for a run: digest, angle and pressure at each point of the profile.
std::string profile_rows(const Study& study, unsigned int run);

/// Takes over the profiles of runs that are solved from the text of any study-profiles.csv. A point
/// that is there several times counts once.
void read_profiles(const std::string& text, Study& study);

} // namespace rollwave
