#ifndef ROLLWAVE_ERROR_BOUND_STRESS_FUNCTION_H
#define ROLLWAVE_ERROR_BOUND_STRESS_FUNCTION_H

#include "rollwave/error_bound/admissible_pressure.h"
#include "rollwave/error_bound/force_integral.h"
#include "rollwave/error_bound/radial_shapes.h"
#include "rollwave/mesh/ring_space.h"
#include "rollwave/solver/spd_solver.h"

#include <memory>
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
 * that are products of StressFunctionBasis in r and polynomials in z on each cell it minimises
 *
 *     int r (tau_z^2 / alpha + tau_r^2) dr dz = int psi_s^2 ds dz + int (G - psi_z)^2 / r dr dz.
 *
 * psi is prescribed on r = b up to a constant, free on the hub, and grows by b int lambda dz in a
 * period.
 */
class StressFunction {
public:
  /// Makes the matrix, which depends on the speed of the scene alone, and prepares to solve with
  /// it.
  /// @param kind that of make_spd_solver()
  /// @param shapes those of the mesh and the scene
  /// @throws NotSolved when memory is short
  StressFunction(const RingSpace& space, const Scene& scene, SolverKind kind,
                 RadialShapesOfMesh& shapes, Work& work);

  /// The nodal values of psi, both sides of the seam having their own, for the matrix' speed.
  /// @param constraints those of stress_function_constraints() for the scene
  /// @param force nullptr when G is a function of r, which does no work: int psi_z dz = 0 for every
  /// periodic psi
  /// @throws NotSolved when memory is short or an iteration fails
  FieldVector solve(RadialShapesOfMesh& shapes,
                    const dealii::AffineConstraints<double>& constraints,
                    const ForceIntegral* force, Work& work);

private:
  /// Adds what the values prescribed in @p lift contribute to the right-hand side.
  void add_load_of(const FieldVector& lift, RadialShapesOfMesh& shapes,
                   const dealii::AffineConstraints<double>& constraints, FieldVector& load) const;
  /// Adds int G psi_z / r dr dz.
  void add_load_of(const ForceIntegral& force, RadialShapesOfMesh& shapes,
                   const dealii::AffineConstraints<double>& constraints, FieldVector& load) const;

  const RingSpace& space;
  const ShapeProducts reference;
  std::unique_ptr<SpdSolver> solver;
};

/// What ties the nodal values of a potential: given on r = b by the pressures, growing in a period,
/// continuous elsewhere.
/// @param pressures one for each of RingSpace::surface_faces(); for degree 1 with zero slopes
dealii::AffineConstraints<double>
stress_function_constraints(const RingSpace& space, const Scene& scene,
                            const std::vector<EdgePressure>& pressures);

} // namespace rollwave

#endif
