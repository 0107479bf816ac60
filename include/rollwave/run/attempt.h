#pragma once

#include <mpi.h>

#include <functional>
#include <string>
#include <vector>

namespace rollwave {

/// Computes an extra of a result, such as its certificate. If that fails, the solution stands, and
/// the failure is added to @p shortfalls.
/// @param missing such as "the error could not be certified"
/// @param advice the change that helps
/// @return true if the part has been computed
/// @throws on several processes any exception except NotSolved: it may be that of one process alone
bool attempt(const std::function<void()>& compute, const std::string& missing,
             const std::string& advice, MPI_Comm communicator,
             std::vector<std::string>& shortfalls);

} // namespace rollwave
