#pragma once

#include "rollwave/error_bound/force_integral.h"
#include "rollwave/error_bound/radial_shapes.h"
#include "rollwave/mesh/contact_boundary.h"
#include "rollwave/solver/contact_equations.h"
#include "rollwave/solver/sparse_factor.h"

#include <deal.II/lac/vector.h>

#include <memory>
#include <utility>

namespace rollwave {

class RunStatistics;
struct Scene;

/// The equations on one mesh. They depend on its space, the speed, and the contact nodes.
struct System {
  ContactBoundary boundary;  ///< of the widest zone of the runs that use it
  RadialShapesOfMesh shapes; ///< of the load and the certificate

  /// The factor of the stiffness matrix. Each process keeps its contact nodes in it. A run frees it
  /// when it has the displacement.
  std::unique_ptr<const SparseFactor> factor;

  std::unique_ptr<CondensedSystem> condensed;
};

/// @param zone the widest of the runs that use the system
/// @throws BadInput without a node in the zone; NotEnoughMemory, or NotSolved where the
/// stiffness matrix is not positive definite in rounded arithmetic
System make_system(const RingSpace& space, const Scene& scene,
                   const std::pair<double, double>& zone, RunStatistics& statistics);

/// The load of a force on a system.
struct Load {
  ForceIntegral integral;
  FieldVector vector;               ///< f
  dealii::Vector<double> condensed; ///< g, the share of this process
};

/// nullptr for a scene without force.
/// @throws BadInput where the force is not finite, NotSolved if the load overflows
std::unique_ptr<const Load> make_load(const System& system, const Scene& scene,
                                      RunStatistics& statistics);

/// The displacement u with K_ii u_i = f_i - K_ik u_k, constraints included.
/// @param load null without force @param kept u_k, ContactState::kept
/// @throws NotSolved where u is not finite
FieldVector expand(const System& system, const Load* load, const dealii::Vector<double>& kept,
                   RunStatistics& statistics);

/// @throws NotSolved if @p number is not finite @param what has overflowed
void require_finite(double number, const std::string& what);

} // namespace rollwave
