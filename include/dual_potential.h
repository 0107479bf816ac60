#ifndef ROLLWAVE_DUAL_POTENTIAL_H
#define ROLLWAVE_DUAL_POTENTIAL_H

#include "edge_pressure.h"
#include "force_jumps.h"
#include "radial_shapes.h"
#include "ring_space.h"
#include "symmetric_solver.h"

#include <memory>
#include <optional>
#include <vector>

namespace rollwave {

struct Scene;
class Work;

/**
 * The potential psi of a flux tau that balances the force and a contact pressure lambda,
 *
 *     r tau_z = psi_r,   r tau_r = G - psi_z,   G(r, z) = int_r^b rho f drho,   psi_z = b lambda on
 *     r = b,
 *
 * so that d_z tau_z + (1/r) d_r (r tau_r) + f = 0 whatever psi is. Among the continuous functions
 * that are products of PotentialShapes in r and polynomials in z on each cell it minimises
 *
 *     int r (tau_z^2 / alpha + tau_r^2) dr dz = int psi_s^2 ds dz + int (G - psi_z)^2 / r dr dz.
 *
 * psi is prescribed on r = b up to a constant, free on the hub, and grows by b int lambda dz in a
 * period. The matrix, with what is prepared to solve with it, is kept while the speed stays the
 * same.
 */
class DualPotential {
public:
  /// @p kind is that of make_symmetric_solver().
  DualPotential(const RingSpace& space, SolverKind kind);

  /// Whether the matrix is that of the scene's speed.
  bool belongs_to(const Scene& scene) const;

  /// Makes it so.
  /// @param shapes those of the mesh and the scene
  /// @param constraints those of solve(), but for inhomogeneities
  /// @throws NotSolved when memory is short
  void turn_to(const Scene& scene, RadialShapesOfMesh& shapes,
               const dealii::AffineConstraints<double>& constraints, Work& work);

  /// The nodal values of psi, both sides of the seam having their own, for the matrix' speed.
  /// @param constraints those of potential_constraints() for the scene
  /// @param force_load int G psi_z / r dr dz, nullptr when G is a function of r, which does no
  /// work: int psi_z dz = 0 for every periodic psi
  /// @throws NotSolved when memory is short or an iteration fails
  FieldVector solve(RadialShapesOfMesh& shapes,
                    const dealii::AffineConstraints<double>& constraints,
                    const FieldVector* force_load, Work& work);

private:
  /// What the values prescribed in @p lift contribute to the right-hand side.
  FieldVector load_of(const FieldVector& lift, RadialShapesOfMesh& shapes,
                      const dealii::AffineConstraints<double>& constraints) const;

  const RingSpace& space;
  const ShapeProducts reference;
  std::optional<double> angular_velocity; ///< of the scene that the matrix belongs to
  std::unique_ptr<SymmetricSolver> solver;
};

/// What ties the nodal values of a potential: given on r = b by the pressures, growing in a period,
/// continuous elsewhere.
/// @param pressures one for each of RingSpace::surface_faces(); for degree 1 with zero slopes
/// @param jumps those of the PotentialKinks that are added
dealii::AffineConstraints<double> potential_constraints(const RingSpace& space, const Scene& scene,
                                                        const std::vector<EdgePressure>& pressures,
                                                        const ForceJumps& jumps);

} // namespace rollwave

#endif
