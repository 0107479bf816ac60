#pragma once

#include "rollwave/exact/exact_solution.h"
#include "rollwave/scene/scene.h"

#include <mpi.h>

#include <optional>
#include <string>

namespace rollwave {

/// The exact solution of a scene; nullopt where there is none: a force that is not constant, a zone
/// that cuts the contact short on one side or unevenly, or a series that does not converge. The
/// reason is written to @p why_none.
/// @throws Interrupted, as solve_exactly()
std::optional<ExactSolution> find_exact_solution(const Scene& scene,
                                                 std::string* why_none = nullptr,
                                                 MPI_Comm communicator = MPI_COMM_SELF);

/// The distance at which the exact solution has Scene::nip, or the load of Scene::load, by
/// falling_zero() from that of @p scene, to the accuracy of the exact answer, 3e-11. nullopt if no
/// exact solution is known. Interrupted as find_exact_solution().
std::optional<double> find_exact_distance(const Scene& scene,
                                          MPI_Comm communicator = MPI_COMM_SELF);

/// -d/dc of the exact vertical load, by a central difference over 1e-3 of the depth by which the
/// free surface would lie in the road; its relative error is of the order of 1e-6. nullopt without
/// contact or where an exact solution is not known.
std::optional<double> find_exact_stiffness(const Scene& scene,
                                           MPI_Comm communicator = MPI_COMM_SELF);

} // namespace rollwave
