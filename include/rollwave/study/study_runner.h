#ifndef ROLLWAVE_STUDY_STUDY_RUNNER_H
#define ROLLWAVE_STUDY_STUDY_RUNNER_H

#include "rollwave/study/study_record.h"

#include <mpi.h>

#include <filesystem>
#include <iosfwd>

namespace rollwave {

/// The runs that a study is to make, none of which has been made.
/// @throws BadInput as plan_runs()
Study plan_study(const Parameters& parameters, MPI_Comm communicator = MPI_COMM_SELF);

/**
 * Makes the runs of a planned @p study and prints the table of the study on @p out, each row when
 * its run has ended. A run that cannot be solved is a row like the others.
 *
 * After each run study.csv and study.jsonl are written to @p directory. What study.jsonl already
 * has of the same runs is not made again, unless a run failed for another reason than its
 * parameters, or lacks files that are wanted of it. A table with rows of other runs is kept as
 * study-before.csv, study-before-2.csv and so on.
 *
 * On several processes all of them make each run together; rank 0 writes.
 *
 * When the user interrupts it, the run at hand ends without a row, unless nothing is missing of it,
 * and no further run is begun.
 *
 * @throws NotWritten; Interrupted before there is a row.
 */
void run_study(Study& study, const Parameters& parameters, const std::filesystem::path& directory,
               std::ostream& out, MPI_Comm communicator = MPI_COMM_SELF);

} // namespace rollwave

#endif
