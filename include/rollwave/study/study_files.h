#pragma once

#include "rollwave/output/output_directory.h"
#include "rollwave/study/study.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rollwave {

/// The names of the files that write_study() may write in the directory of a study.
std::vector<std::string> study_file_names(const Parameters& parameters);

/// Writes the tables of the runs that have ended: study.csv, study-profiles.csv, study.txt and
/// study.tex (a table for the screen and for LaTeX); study.pvd (the fields of the runs, if they are
/// written) and the pictures of draw_study().
/// @param text of study.txt
/// @param older files that were there before, of which the others are named in a remark
/// @throws NotWritten
WrittenFiles write_study(const Parameters& parameters, const Study& study, const std::string& text,
                         std::vector<std::filesystem::path> older);

} // namespace rollwave
