#ifndef ROLLWAVE_FORCE_CONTRIBUTION_H
#define ROLLWAVE_FORCE_CONTRIBUTION_H

#include "force_columns.h"
#include "radial_shapes.h"
#include "ring_space.h"

#include <vector>

namespace rollwave {

/// What a force that is no number contributes to the certificates of all scenes on one mesh with
/// one speed, G = int_r^b rho f_0 drho.
struct ForceContribution {
  /// @param constraints those of potential_constraints(), with any pressures
  /// @param columns of Gauss' rule with degree + 2 points
  ForceContribution(const RingSpace& space, const dealii::AffineConstraints<double>& constraints,
                    RadialShapesOfMesh& shapes, ForceColumns& columns, const ForceJumps& jumps);

  /// int [(G - y_z) psi_z / r dr - y_s psi_s ds] dz, y the PotentialKinks
  FieldVector to_potential;
  /// The same for the products of bubbles and psi_i, i from the hub, for each active cell
  std::vector<double> to_bubbles;
  double missed; ///< MissedMoment
};

} // namespace rollwave

#endif
