#ifndef ROLLWAVE_STUDY_STUDY_RUNNER_H
#define ROLLWAVE_STUDY_STUDY_RUNNER_H

#include "rollwave/study/study_record.h"

#include <mpi.h>

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace rollwave {

struct Study {
  std::vector<StudyRun> runs;
  std::string shortfall; ///< where the user has interrupted it; mostly empty
};

/**
 * Runs every combination of the values in `Study/Vary`, the last key varying fastest, for each of
 * `Study/Scenes` where there are some, and tells of each on @p progress. A run that cannot be
 * solved is a row of the study like the others.
 *
 * After each run study.csv is written to @p directory. When the directory holds the rows of the
 * same study, that is beside a parameters.prm with the same text, only the missing runs are made.
 *
 * On several processes all of them make each run together, or groups of `Study/Processes per scene`
 * make several at a time; the first of them writes.
 *
 * When the user interrupts it, the run at hand ends without a row, unless nothing is missing of it,
 * and no further run is begun.
 *
 * @throws BadInput before the first run when any run's parameters are not admitted, or
 *         `Study/Published steps` does not have one entry for each run; NotWritten; Interrupted
 *         before there is a row.
 */
Study run_study(const Parameters& parameters, const std::filesystem::path& directory,
                std::ostream& progress, MPI_Comm communicator = MPI_COMM_SELF);

} // namespace rollwave

#endif
