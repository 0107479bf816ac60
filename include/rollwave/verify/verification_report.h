#pragma once

#include "rollwave/exact/exact_solution.h"
#include "rollwave/run/result.h"
#include "rollwave/scene/scene.h"

#include <iosfwd>
#include <optional>

namespace rollwave {

/// Prints the numbers of @p result next to the exact ones, in the user's units.
void report_verification(std::ostream& out, const Scene& scene, const Result& result,
                         const ExactSolution& exact, std::optional<double> exact_stiffness);

} // namespace rollwave
