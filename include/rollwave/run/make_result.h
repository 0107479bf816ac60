#pragma once

#include "rollwave/run/mesh.h"
#include "rollwave/run/result.h"
#include "rollwave/run/run_options.h"
#include "rollwave/run/solve_on_mesh.h"

#include <optional>
#include <vector>

namespace rollwave {

/// The result of a run.
/// @param solution on the last mesh
/// @param certificate of the solution, where it was made
/// @param cycles one for each mesh
Result make_result(const RunOptions& options, const Mesh& mesh, const MeshSolution& solution,
                   const std::optional<Certificate>& certificate, std::vector<CycleFigures> cycles,
                   bool is_interrupted, RunStatistics statistics);

} // namespace rollwave
