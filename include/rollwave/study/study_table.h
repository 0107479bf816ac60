#pragma once

#include "rollwave/study/study.h"

#include <string>

namespace rollwave {

/// One line on a run that has ended, for the screen while the study goes on.
std::string line_of_run(const Study& study, unsigned int run);

/// The text of study.txt: a table of the runs that have ended, one in each row: scene, varied keys,
/// the known quantities with the flag Shown::scene_table where only keys of the scene vary,
/// otherwise with Shown::table, and outcome. Below it the meaning of the columns, the first
/// failure, the first shortfall and the first remarks, each with the number of runs that have one,
/// and the orders of convergence. study.csv has the failures and remarks of every run.
std::string study_text(const Study& study);

/// The table as a LaTeX document.
std::string table_as_tex(const Study& study);

} // namespace rollwave
