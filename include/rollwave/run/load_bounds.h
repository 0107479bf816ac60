#pragma once

#include "rollwave/run/solve_on_mesh.h"

namespace rollwave {

/**
 * Guaranteed bounds of the work-conjugate load G = b int lambda dphi/dc dz of a road that is not
 * convex. With the zone of possible contact kept, the least energy E(c) = min J is a convex
 * function of the road distance c with E'(c) = -G, so that
 *
 *     (E(c) - E(c + d))/d <= G <= (E(c - d) - E(c))/d   for every d > 0,
 *
 * and certified bounds of the three energies, on the same mesh, give bounds of G. The curvature of
 * E opens them by |G'| d/2, the width w of the energy bounds by w/d: d is the square root of 2 w /
 * |G'|.
 *
 * @p solution is that of its scene on the @p mesh, with the certified @p error.
 * @throws NotSolved when a solver fails.
 */
Bounds bound_load(const RunOptions& options, Discretisation& mesh, const MeshSolution& solution,
                  const CertifiedError& error, RunStatistics& statistics);

/// Guaranteed bounds of the distance c at which the work-conjugate load is G, by the same energies:
/// the road is nearer than c + d where (E(c) - E(c + d))/d <= G is certified, and farther than c -
/// d where G <= (E(c - d) - E(c))/d is. nullopt where no d up to a hundredth of c is large enough.
std::optional<Bounds> bound_distance(const RunOptions& options, Discretisation& mesh,
                                     const MeshSolution& solution, const CertifiedError& error,
                                     RunStatistics& statistics);

} // namespace rollwave
