#ifndef ROLLWAVE_VERIFICATION_H
#define ROLLWAVE_VERIFICATION_H

#include "exact_solution.h"
#include "simulation.h"

#include <iosfwd>
#include <optional>

namespace rollwave {

/// The exact solution of a scene; nullopt where there is none: a force that is not constant, a zone
/// that cuts the contact short on one side or unevenly, or a series that does not settle.
std::optional<ExactSolution> find_exact_solution(const Scene& scene, const Parameters& parameters);

/// Prints our numbers beside the exact ones, with their differences, in the user's lengths.
void report_verification(std::ostream& out, const Scene& scene, const Result& result,
                         const ExactSolution& exact);

} // namespace rollwave

#endif
