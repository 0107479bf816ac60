#pragma once

#include "rollwave/run/mesh.h"
#include "rollwave/run/result.h"
#include "rollwave/run/run_options.h"
#include "rollwave/run/solve_on_mesh.h"

#include <vector>

namespace rollwave {

/// The notes on a result. A remark says that contact ends with the zone, that the surface lies
/// within the road outside of it, that the relative bound is 1 or more, that the mesh does not
/// resolve the contact, that displacements exceed a quarter of the ring's thickness, that a speed
/// was rounded above the critical one, or that a drum is thin. A shortfall says that the wanted
/// error was not reached or, if there is no other shortfall, that the conditions of contact and
/// equilibrium do not hold to Residuals::allowed.
/// @param result of the solution, with the notes that were made before
std::vector<Note> notes_on(const RunOptions& options, const Mesh& mesh,
                           const MeshSolution& solution, const Result& result);

} // namespace rollwave
