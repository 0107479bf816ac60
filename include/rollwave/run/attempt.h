#pragma once

#include "rollwave/base/note.h"

#include <mpi.h>

#include <exception>
#include <functional>
#include <string>
#include <vector>

namespace rollwave {

/// Why something failed, in one line, without the advice of NotEnoughMemory.
std::string reason_of(const std::exception& failure);

/// Computes an additional part of a result, such as the certificate. If that fails, the solution is
/// kept, and the failure becomes a shortfall among the @p notes.
/// @param missing such as "the error could not be certified"
/// @param advice the change that helps
/// @throws on several processes any exception except NotSolved: a single process may have thrown it
void attempt(const std::function<void()>& compute, const std::string& missing,
             const std::string& advice, MPI_Comm communicator, std::vector<Note>& notes);

} // namespace rollwave
