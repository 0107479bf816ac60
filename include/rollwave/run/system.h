#pragma once

#include "rollwave/error_bound/force_integral.h"
#include "rollwave/mesh/contact_boundary.h"
#include "rollwave/solver/condensed_system.h"
#include "rollwave/solver/stiffness_factor.h"

#include <deal.II/lac/vector.h>

#include <memory>
#include <utility>

namespace rollwave {

class RunStatistics;
struct Scene;

/// The equations on one mesh. They depend on its space, the speed, and the contact nodes.
struct System {
  ContactBoundary boundary;                      ///< of the widest zone of the runs that use it
  std::unique_ptr<const StiffnessFactor> factor; ///< a run frees it when it has the displacement
  std::unique_ptr<const CondensedSystem> condensed;
};

/// @param zone the widest of the runs that use the system
/// @throws BadInput without a node in the zone; NotEnoughMemory, NotSolved as StiffnessFactor
System make_system(const RingSpace& space, const Scene& scene,
                   const std::pair<double, double>& zone, RunStatistics& statistics);

/// The load of a force on a system.
struct Load {
  ForceIntegral integral;
  FieldVector vector;               ///< f
  dealii::Vector<double> condensed; ///< g
};

/// nullptr for a scene without force.
/// @throws BadInput where the force is not finite, NotSolved if the load overflows
std::unique_ptr<const Load> make_load(const System& system, const Scene& scene,
                                      RunStatistics& statistics);

/// @throws NotSolved if @p number is not finite @param what has overflowed
void require_finite(double number, const std::string& what);

} // namespace rollwave
