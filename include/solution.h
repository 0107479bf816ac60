#ifndef ROLLWAVE_SOLUTION_H
#define ROLLWAVE_SOLUTION_H

#include "certificate.h"
#include "mesh_system.h"
#include "result.h"
#include "ring_space.h"

#include <memory>
#include <optional>

namespace rollwave {

/// A solved scene with its field; the members are listed in the order of their dependence.
struct Solution {
  std::unique_ptr<dealii::Triangulation<2>> triangulation;
  std::unique_ptr<RingSpace> space;
  MeshSystem system;        ///< empty but for what simulate_next() keeps
  FieldVector displacement; ///< u_h
  std::optional<Certificate> certificate;
  Result result;
};

} // namespace rollwave

#endif
