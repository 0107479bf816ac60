#ifndef ROLLWAVE_RUN_REMARKS_H
#define ROLLWAVE_RUN_REMARKS_H

#include "rollwave/run/result.h"
#include "rollwave/run/run_options.h"
#include "rollwave/run/solve_on_mesh.h"

#include <string>
#include <vector>

namespace rollwave {

/// What a reader of the figures should know beside them: that contact ends with the zone, that the
/// surface lies within the road outside of it, that the bound of the error says nothing, that the
/// mesh does not resolve the contact, or that displacements exceed the thickness of the ring.
std::vector<std::string> remarks_on(const RunOptions& options, const MeshSolution& solution,
                                    const Result& result);

/// What of the wanted error is missing and why, and what to do.
std::string missing_error_text(const RunOptions& options, const Result& result,
                               bool is_at_finest_level);

/// That the conditions of contact and equilibrium do not hold as well as wanted.
std::string residual_text(const Residuals& residuals);

} // namespace rollwave

#endif
