#ifndef ROLLWAVE_RUN_LOAD_BOUNDS_H
#define ROLLWAVE_RUN_LOAD_BOUNDS_H

#include "rollwave/run/solve_on_mesh.h"

namespace rollwave {

/**
 * Guaranteed bounds of the work-conjugate load G = b int lambda / cos(z - 3 pi/2) dz of a flat
 * road. With the zone of possible contact kept, the least energy E(c) = min J is a convex function
 * of the road distance c with E'(c) = -G, so that
 *
 *     (E(c) - E(c + d))/d <= G <= (E(c - d) - E(c))/d   for every d > 0,
 *
 * and certified bounds of the three energies, on the same mesh, give bounds of G. The curvature of
 * E opens them by |G'| d/2, the width w of the energy bounds by w/d: d is the square root of 2 w /
 * |G'|, with G' guessed from G and the half-width of contact.
 *
 * @p solution is that of @p scene on @p space by @p system, with @p result.
 * @throws NotSolved when a solver fails.
 */
LoadBounds bound_load(const Scene& scene, const RunOptions& options, const RingSpace& space,
                      const MeshSolution& solution, MeshCache& system, Result& result);

} // namespace rollwave

#endif
