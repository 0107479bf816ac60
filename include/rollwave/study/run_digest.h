#pragma once

#include "rollwave/parameters/parameters.h"

#include <string>

namespace rollwave {

/**
 * A digest of what the row of a run depends on: its options as the program holds them, the
 * comparison with the exact answer, and the build of the program. Names of units do not belong to
 * it, nor does the way in which a value is spelt.
 */
std::string digest_of_run(const RunOptions& options, bool has_true_errors);

/// A digest of the same and of all that the run's own files depend on.
std::string digest_of_files(const std::string& digest_of_run, const Parameters& study);

} // namespace rollwave
