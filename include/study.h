#ifndef ROLLWAVE_STUDY_H
#define ROLLWAVE_STUDY_H

#include "result.h"

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace rollwave {

/// One run of a study: the settings in which it differs from the others, and what came of it.
struct StudyRun {
  std::vector<Setting> settings;
  std::optional<Result> result; ///< nullopt when the scene was not solved
  std::string failure;          ///< why it was not
  std::optional<unsigned int> published_steps;
  double peak_memory_mib = 0; ///< of the process, up to the end of this run
};

/**
 * Runs every combination of the values in `Study/Vary`, the last key varying fastest, and tells of
 * each on @p progress. A run that cannot be solved is a row of the study like the others.
 *
 * @throws BadInput before the first run when any run's parameters are not admitted, or
 *         `Study/Published steps` does not have one entry for each run.
 */
std::vector<StudyRun> run_study(const Parameters& parameters, std::ostream& progress);

} // namespace rollwave

#endif
