#pragma once

#include "rollwave/base/run_statistics.h"
#include "rollwave/contact/contact_problem.h"
#include "rollwave/run/result.h"

#include <functional>

namespace rollwave {

/// Functions that a run calls while it lasts; each may be empty.
struct Progress {
  RunStatistics::Observer phase_ended;
  ContactObserver contact_step_ended;

  /// Called when a mesh of an adaptive run has been solved. @param number from 1 on
  std::function<void(unsigned int number, const CycleFigures& mesh)> mesh_solved;
};

} // namespace rollwave
