#ifndef ROLLWAVE_ERROR_BOUND_CONSTITUTIVE_ERROR_H
#define ROLLWAVE_ERROR_BOUND_CONSTITUTIVE_ERROR_H

#include "rollwave/error_bound/admissible_displacement.h"
#include "rollwave/error_bound/angular_enrichment.h"

#include <vector>

namespace rollwave {

struct Scene;

/// What a Certificate is made of: v = displacement + c xi, c that of the trace and xi linear from 0
/// to 1 across the row of cells at the surface; psi = potential + bubbles.
struct AdmissibleFields {
  const FieldVector& displacement; ///< u_h, with the contact nodes on the road or before it
  const AdmissibleTrace& trace;
  const std::vector<EdgePressure>& pressures; ///< lambda without the bubbles' share
  const FieldVector& potential;
  const AngularEnrichment& bubbles;
  const ForceIntegral* force; ///< nullptr without force
};

/// Sums over all processes.
struct ConstitutiveError {
  double bound_squared;            ///< eta^2
  double norm_squared;             ///< a(v, v)
  double work_of_force;            ///< int G_h v_r dr dz
  double work_of_correction;       ///< int G_h (v - u_h)_r dr dz
  std::vector<double> cell_bounds; ///< of each active cell: (its share of eta^2 and delta^2)^(1/2)
};

ConstitutiveError integrate_constitutive_error(const RingSpace& space, const Scene& scene,
                                               const AdmissibleFields& fields,
                                               RadialShapesOfMesh& shapes);

} // namespace rollwave

#endif
