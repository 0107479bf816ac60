#ifndef ROLLWAVE_ERROR_BOUND_CONSTITUTIVE_ERROR_H
#define ROLLWAVE_ERROR_BOUND_CONSTITUTIVE_ERROR_H

#include "rollwave/error_bound/admissible_displacement.h"
#include "rollwave/error_bound/admissible_pressure.h"
#include "rollwave/mesh/ring_space.h"

#include <vector>

namespace rollwave {

struct DualProblem;
struct Scene;
class AngularEnrichment;

/// What a Certificate consists of, with psi = @p potential + @p bubbles and v = u_h + c xi, xi
/// linear from 0 to 1 across the row of cells at the surface: the sums over all processes.
struct ConstitutiveError {
  double bound_squared;            ///< eta^2
  double norm_squared;             ///< a(v, v)
  double work_of_force;            ///< int G_h v_r dr dz
  double work_of_correction;       ///< int G_h (v - u_h)_r dr dz
  std::vector<double> cell_bounds; ///< of each active cell: (its share of eta^2 and delta^2)^(1/2)
};

/// @param displacement u_h, with the contact nodes on the road or before it
/// @param trace v of it on the surface
/// @param pressures lambda without the bubbles' share
ConstitutiveError integrate_constitutive_error(const RingSpace& space, const Scene& scene,
                                               const FieldVector& displacement,
                                               const AdmissibleTrace& trace,
                                               const std::vector<EdgePressure>& pressures,
                                               const FieldVector& potential,
                                               const AngularEnrichment& bubbles, DualProblem& dual);

} // namespace rollwave

#endif
