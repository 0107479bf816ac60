#ifndef ROLLWAVE_STUDY_STUDY_TABLE_H
#define ROLLWAVE_STUDY_STUDY_TABLE_H

#include "rollwave/output/output_directory.h"
#include "rollwave/study/study_record.h"

#include <iosfwd>

namespace rollwave {

/// Prints the runs as a table aligned for reading. With true errors, each has its observed order
/// beside it: the slope over h from the run before of the same curve, h ~ unknowns^(-1/2).
void print_study(std::ostream& out, const std::vector<StudyRun>& runs);

/// Beside study.csv, which run_study() keeps, writes study.txt, study.tex (a LaTeX table) and
/// plots: study.svg, contact steps over the key that varies fastest, and with true errors
/// study-h.svg, study-unknowns.svg and study-time.svg, the relative error in the energy norm over
/// h, unknowns and seconds, and study-steps.svg and study-iterations.svg, contact steps and linear
/// iterations over unknowns.
/// @throws NotWritten.
WrittenFiles write_study(const std::filesystem::path& directory, const Parameters& parameters,
                         const std::vector<StudyRun>& runs);

} // namespace rollwave

#endif
