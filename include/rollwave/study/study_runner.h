#ifndef ROLLWAVE_STUDY_STUDY_RUNNER_H
#define ROLLWAVE_STUDY_STUDY_RUNNER_H

#include "rollwave/study/study_record.h"

#include <mpi.h>

#include <filesystem>
#include <iosfwd>

namespace rollwave {

/**
 * Makes all runs of plan_runs() and prints the table of the study on @p out, each row when its run
 * has ended. A run that cannot be solved is a row like the others.
 *
 * After each run study.csv and study.jsonl are written to @p directory. What study.jsonl already
 * has of the same runs is not made again, unless a run failed for another reason than its
 * parameters, or lacks files that are wanted of it. A table with rows of other runs is kept as
 * study-before.csv, study-before-2.csv and so on.
 *
 * On several processes all of them make each run together, or groups of `Study/Processes per scene`
 * make several at a time; the first of them writes.
 *
 * When the user interrupts it, the run at hand ends without a row, unless nothing is missing of it,
 * and no further run is begun.
 *
 * @throws BadInput as plan_runs(), before anything is written; NotWritten; Interrupted before there
 *         is a row.
 */
Study run_study(const Parameters& parameters, const std::filesystem::path& directory,
                std::ostream& out, MPI_Comm communicator = MPI_COMM_SELF);

} // namespace rollwave

#endif
