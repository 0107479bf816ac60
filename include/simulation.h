#ifndef ROLLWAVE_SIMULATION_H
#define ROLLWAVE_SIMULATION_H

#include "certificate.h"
#include "result.h"
#include "ring_space.h"
#include "scene.h"

#include <memory>

namespace rollwave {

/// A solved scene with its field; the members are listed in the order of their dependence.
struct Solution {
  std::unique_ptr<dealii::Triangulation<2>> triangulation;
  std::unique_ptr<RingSpace> space;
  FieldVector displacement; ///< u_h
  std::optional<Certificate> certificate;
  Result result;
};

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
