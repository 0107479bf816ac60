#ifndef ROLLWAVE_BOUND_INTEGRALS_H
#define ROLLWAVE_BOUND_INTEGRALS_H

#include "edge_pressure.h"
#include "feasible_trace.h"
#include "ring_space.h"

#include <vector>

namespace rollwave {

struct DualParts;
struct Scene;
class AngularBubbles;

/// What a Certificate consists of, with psi = @p potential + @p bubbles + kinks and v = u_h + c xi,
/// xi linear from 0 to 1 across the row of cells at the surface: the sums over all processes.
struct BoundIntegrals {
  double bound_squared;            ///< eta^2 but for what the rules miss of G
  double norm_squared;             ///< a(v, v)
  double work_of_force;            ///< (f_0, v) = int G v_r dr dz
  double work_of_rest;             ///< (f_0, v - u_h)
  std::vector<double> cell_bounds; ///< eta of each active cell
};

/// In two threads where that gains time; the digits do not depend on it.
/// @param displacement u_h, with the contact nodes on the road or before it
/// @param trace v of it on the surface
/// @param pressures lambda without the bubbles' share
/// @param dual in which the shapes and lines of all own cells have been made: by AngularBubbles,
/// and under a force that is no number by its ForceContribution
BoundIntegrals integrate_bound(const RingSpace& space, const Scene& scene,
                               const FieldVector& displacement, const FeasibleTrace& trace,
                               const std::vector<EdgePressure>& pressures,
                               const FieldVector& potential, const AngularBubbles& bubbles,
                               const DualParts& dual);

} // namespace rollwave

#endif
