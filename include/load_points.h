#ifndef ROLLWAVE_LOAD_POINTS_H
#define ROLLWAVE_LOAD_POINTS_H

#include "force_panels.h"
#include "radial_extents.h"
#include "ring_space.h"

#include <vector>

namespace rollwave {

/// m = rho (f - f_0) at the points of the load on a panel, weighted by area. Only where these are
/// closer to each other than the panel's own, in r or in z.
struct MissedAtLoadPoints {
  unsigned int n_points = 0;
  double mean = 0, mean_square = 0;
};

/// For each panel from number @p first on, none where it is not a part. The same on all processes.
/// @param moments r f at the points of the load (Load)
/// @param extents those of the space
std::vector<MissedAtLoadPoints> missed_at_load_points(const RingSpace& space,
                                                      const ForcePanels& panels, unsigned int first,
                                                      const std::vector<double>& moments,
                                                      const RadialExtents& extents);

} // namespace rollwave

#endif
