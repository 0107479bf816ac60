#pragma once

#include "rollwave/error_bound/admissible_pressure.h"
#include "rollwave/error_bound/force_integral.h"
#include "rollwave/error_bound/radial_shapes.h"
#include "rollwave/mesh/ring_space.h"
#include "rollwave/solver/condensed_system.h"
#include "rollwave/solver/sparse_factor.h"

#include <memory>
#include <vector>

namespace rollwave {

struct Scene;
class RunStatistics;

/**
 * The linear problem for the stress function psi of a flux tau that balances the force and a
 * contact pressure lambda,
 *
 *     r tau_z = psi_r,   r tau_r = Q - psi_z,   Q(r, z) = int_r^b rho f drho,   psi_z = b lambda on
 *     r = b,
 *
 * so that d_z tau_z + (1/r) d_r (r tau_r) + f = 0 whatever psi is. Among the continuous functions
 * that are products of StressFunctionBasis in r and polynomials in z on each cell it minimises
 *
 *     int r (tau_z^2 / alpha + tau_r^2) dr dz = int psi_s^2 ds dz + int (Q - psi_z)^2 / r dr dz.
 *
 * psi is prescribed on r = b up to a constant, free on the hub, and grows by b int lambda dz in a
 * period.
 */
class DualSystem {
public:
  /// Factorises the matrix, which depends on the space and the speed of the scene alone.
  /// @param shapes of the same space and speed, must outlive it, as the space must
  /// @throws NotEnoughMemory, NotSolved
  DualSystem(const RingSpace& space, const RadialShapesOfMesh& shapes, const Scene& scene,
             RunStatistics& statistics);

  /// The nodal values of psi, both sides of the seam having their own, for a scene of this speed.
  /// @param pressures one for each of RingSpace::surface_edges()
  /// @param force that of the scene, nullptr without
  FieldVector stress_function(const Scene& scene, const std::vector<EdgePressure>& pressures,
                              const ForceIntegral* force, RunStatistics& statistics) const;

  const RadialShapesOfMesh& shapes() const { return radial; }

private:
  const RingSpace& space;
  const RadialShapesOfMesh& radial;
  std::unique_ptr<const SparseFactor> factor;
  std::unique_ptr<CondensedSystem> condensed; ///< of the unknowns between processes
};

} // namespace rollwave
