#pragma once

#include "rollwave/study/study_record.h"

#include <mpi.h>

#include <iosfwd>
#include <optional>
#include <string>

namespace rollwave {

/// The runs of a study, not yet solved. @throws BadInput as plan_runs(), and for a part that has no
/// runs
Study plan_study(const Parameters& parameters, const std::optional<StudyPart>& part = {});

/// True for the names of tables of parts.
bool is_table_of_part(const std::string& name);

/**
 * Makes the runs of a planned @p study, or its part of them, and prints a line on @p out when a run
 * has ended. If a run cannot be solved, its row has the reason, and the study continues.
 *
 * The tables are study.csv and study-profiles.csv, or study.part-K-of-N.csv and
 * study-profiles.part-K-of-N.csv for a part. Each run adds its rows to them; in the end they are
 * written anew, in the order of the study. A run is not made if one of these tables, of the study
 * or of any part, has its row, and the directory of its files is there, if it has some.
 *
 * On several processes all of them make each run together; rank 0 writes.
 *
 * When the user interrupts it, no further run begins. The current run ends after its current mesh,
 * and gets a row only if that was its last.
 *
 * @return the number of runs that were made
 * @throws NotWritten; Interrupted before there is a row; BadValue if the directory of a run has a
 *         file of somebody else.
 */
unsigned int run_study(Study& study, const Parameters& parameters, std::ostream& out,
                       MPI_Comm communicator = MPI_COMM_SELF);

} // namespace rollwave
