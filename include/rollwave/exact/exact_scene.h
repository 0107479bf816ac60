#pragma once

#include "rollwave/scene/road.h"
#include "rollwave/scene/uniform_force.h"

#include <deal.II/base/numbers.h>

namespace rollwave {

/// The scenes that have a semi-analytic answer: a road like all of `Road`, a constant force
/// density and a zone of possible contact |z - 3 pi/2| <= zone_half_width, which may cut the
/// contact short.
struct ExactScene {
  double inner_radius;
  double outer_radius;
  double angular_velocity;
  Road road;
  double force_density;
  double zone_half_width = dealii::numbers::PI_2;

  /// u_f(r), the displacement without contact, a length.
  double contact_free_displacement(double r) const {
    return force_density * contact_free_unit_displacement(inner_radius, outer_radius, r);
  }
};

} // namespace rollwave
