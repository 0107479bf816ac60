#pragma once

#include "rollwave/run/simulation.h"

#include <optional>

namespace rollwave {

/// The solution on the last mesh of a run.
struct LastSolution {
  MeshSolution solution;
  std::optional<Certificate> certificate; ///< where it was made
  bool is_interrupted = false;            ///< before all meshes were made
};

/// The outcome of a run. @throws BadValue for a load or a nip out of reach
Solution finish(Run run, LastSolution last);

} // namespace rollwave
