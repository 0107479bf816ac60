#ifndef ROLLWAVE_RUN_SOLUTION_H
#define ROLLWAVE_RUN_SOLUTION_H

#include "rollwave/error_bound/error_bound.h"
#include "rollwave/mesh/ring_space.h"
#include "rollwave/run/mesh_cache.h"
#include "rollwave/run/result.h"
#include "rollwave/scene/scene.h"

#include <memory>
#include <optional>

namespace rollwave {

/// A solved scene with its field; the members are listed in the order of their dependence.
struct Solution {
  Scene scene; ///< with the distance that a given load needs
  std::unique_ptr<dealii::Triangulation<2>> triangulation;
  std::unique_ptr<RingSpace> space;
  MeshCache system;         ///< empty but for what simulate_next() keeps
  FieldVector displacement; ///< u_h
  std::optional<Certificate> certificate;
  Result result;
};

} // namespace rollwave

#endif
