#pragma once

#include "rollwave/study/study_record.h"

#include <mpi.h>

#include <iosfwd>

namespace rollwave {

/// The runs of a study, not yet solved. @throws BadInput as plan_runs()
Study plan_study(const Parameters& parameters);

/**
 * Makes the runs of a planned @p study and prints a line on @p out when a run has ended. If a run
 * cannot be solved, its row has the reason, and the study continues.
 *
 * Each run adds its row to study.csv, and its pressures to study-profiles.csv.
 * Where parameters.prm in the directory is that of the same study, runs that study.csv has as
 * solved are not made again; otherwise these files begin anew.
 *
 * On several processes all of them make each run together; rank 0 writes.
 *
 * When the user interrupts it, no further run begins. The current run ends after its current mesh,
 * and gets a row only if that was its last.
 *
 * @throws NotWritten; Interrupted before there is a row.
 */
void run_study(Study& study, const Parameters& parameters, std::ostream& out,
               MPI_Comm communicator = MPI_COMM_SELF);

} // namespace rollwave
