#pragma once

#include "rollwave/run/result.h"
#include "rollwave/run/run_options.h"
#include "rollwave/run/solve_on_mesh.h"

#include <string>
#include <vector>

namespace rollwave {

/// Notes for a reader of the numbers: that contact ends with the zone, that the
/// surface lies within the road outside of it, that the relative bound is 1 or more, that the
/// mesh does not resolve the contact, that displacements exceed a quarter of the ring's thickness,
/// that a speed was rounded above the critical one, or that a drum is thin.
std::vector<std::string> remarks_on(const RunOptions& options, const MeshSolution& solution,
                                    const Result& result);

/// A text on the certified error that was reached, and which parameter to change.
std::string missing_error_text(const RunOptions& options, const Result& result,
                               bool is_at_finest_level);

/// A text on conditions of contact and equilibrium that do not hold to Residuals::allowed.
std::string residual_text(const Residuals& residuals);

} // namespace rollwave
