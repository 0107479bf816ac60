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
 * and certified bounds of the three energies, on the same mesh, give bounds of G. Each bound is off
 * by about |G'| d/2 because E is curved, and by w/d because the bounds of the energy have the width
 * w. d = (2 w / |G'|)^(1/2) makes both equal.
 *
 * @p solution is that of its scene on the @p mesh, with the certified @p error.
 * @throws NotSolved when a solver fails.
 */
Bounds bound_load(const RunOptions& options, Discretisation& mesh, const MeshSolution& solution,
                  const CertifiedError& error, RunStatistics& statistics);

/// Guaranteed bounds of the distance at which the work-conjugate load is G, by the same energies.
/// If (E(c) - E(c + d))/d <= G is certified, this distance is at most c + d. If
/// G <= (E(c - d) - E(c))/d is certified, it is at least c - d. nullopt if no d <= c/100 suffices.
std::optional<Bounds> bound_distance(const RunOptions& options, Discretisation& mesh,
                                     const MeshSolution& solution, const CertifiedError& error,
                                     RunStatistics& statistics);

} // namespace rollwave
