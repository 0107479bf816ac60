#pragma once

#include "rollwave/study/study.h"

#include <mpi.h>

#include <iosfwd>
#include <optional>

namespace rollwave {

/// The runs of a study, not yet solved. @throws BadInput as plan_runs()
Study plan_study(const Parameters& parameters, const std::optional<StudyPart>& part = {});

/**
 * Makes the runs of a planned @p study, or its part of them, and prints a line on @p out when a run
 * has ended. If a run cannot be solved, the study has the reason, and continues.
 *
 * A run that is solved gets its record, after its files. A run is not made if it is known, see
 * known_run(). Any number of calls may work in a directory at once.
 *
 * On several processes all of them make each run together; rank 0 writes.
 *
 * When the user interrupts it, no further run begins. The current run ends after its current mesh,
 * and gets a record only if that was its last.
 *
 * @return the number of runs that were made
 * @throws NotWritten; Interrupted before a run is known.
 */
unsigned int run_study(Study& study, const Parameters& parameters, std::ostream& out,
                       MPI_Comm communicator = MPI_COMM_SELF);

} // namespace rollwave
