#ifndef ROLLWAVE_RUN_ATTEMPT_H
#define ROLLWAVE_RUN_ATTEMPT_H

#include "rollwave/run/result.h"

#include <mpi.h>

#include <functional>
#include <string>

namespace rollwave {

/// Computes a part that @p result can do without, such as its certificate. The solution stands
/// where that fails, and the failure is a shortfall.
/// @param missing such as "the error could not be certified"
/// @param advice the change that helps
/// @return true if the part has been computed
/// @throws any exception but NotSolved on several processes: it may be that of this process only
bool attempt(const std::function<void()>& compute, const std::string& missing,
             const std::string& advice, MPI_Comm communicator, Result& result);

} // namespace rollwave

#endif
