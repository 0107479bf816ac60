#pragma once

#include "rollwave/run/result.h"
#include "rollwave/run/solve_on_mesh.h"

namespace rollwave {

/// The result of a solution on one mesh. It lacks error bounds, the list of meshes, and work.
Result measure(const MeshSolution& solution);

} // namespace rollwave
