#ifndef ROLLWAVE_BOUND_INTEGRALS_H
#define ROLLWAVE_BOUND_INTEGRALS_H

#include "edge_pressure.h"
#include "feasible_trace.h"
#include "ring_space.h"

#include <vector>

namespace rollwave {

struct DualProblem;
struct Scene;
class AngularBubbles;

/// What a Certificate consists of, with psi = @p potential + @p bubbles and v = u_h + c xi, xi linear
/// from 0 to 1 across the row of cells at the surface: the sums over all processes.
struct BoundIntegrals {
  double bound_squared;            ///< eta^2
  double norm_squared;             ///< a(v, v)
  double work_of_force;            ///< int G_h v_r dr dz
  double work_of_correction;       ///< int G_h (v - u_h)_r dr dz
  std::vector<double> cell_bounds; ///< of each active cell: (its share of eta^2 and delta^2)^(1/2)
};

/// @param displacement u_h, with the contact nodes on the road or before it
/// @param trace v of it on the surface
/// @param pressures lambda without the bubbles' share
BoundIntegrals integrate_bound(const RingSpace& space, const Scene& scene,
                               const FieldVector& displacement, const FeasibleTrace& trace,
                               const std::vector<EdgePressure>& pressures,
                               const FieldVector& potential, const AngularBubbles& bubbles,
                               DualProblem& dual);

} // namespace rollwave

#endif
