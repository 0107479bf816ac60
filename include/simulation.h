#ifndef ROLLWAVE_SIMULATION_H
#define ROLLWAVE_SIMULATION_H

#include "scene.h"
#include "solution.h"

namespace rollwave {

/**
 * Solves @p scene on the mesh and by the methods of @p parameters; with adaptive cycles: solve,
 * certify where needed, indicate, mark, refine, beginning each contact iteration with the pressure
 * of the mesh before. What was wanted and could not be reached is told in Result::shortfall.
 *
 * @throws BadInput for a mesh or force that cannot be used, NotSolved when a solver fails.
 */
Solution simulate(const Scene& scene, const Parameters& parameters);

} // namespace rollwave

#endif
