#ifndef ROLLWAVE_FORCE_PANEL_CHOICE_H
#define ROLLWAVE_FORCE_PANEL_CHOICE_H

#include "force_panels.h"
#include "radial_extents.h"
#include "ring_space.h"

#include <vector>

namespace rollwave {

struct Scene;

/**
 * Panels for the force of a scene, the same on all processes.
 *
 * They are halved until each has a small share of the mesh's cells, then the worst first until they
 * leave out 1e-5 of what is negligible, as many as the mesh pays for; in the direction in which f
 * is rougher, or where it has a straight_jump(). They are not halved either where even the mean of
 * f would leave out a negligible part. There f_0 becomes that mean, and m_0 the root mean square of
 * m, unless the panel is resolved.
 *
 * The points of a panel may miss what the load sees. On panels that are lower than two cells and
 * longer than a dozen, or the other way round, m is taken on the middle line at each cell as well;
 * and last on all at the points of the load, where these are closer than the panel's own. Where its
 * mean square there is more than four times what the panel's points say, m is taken for as large,
 * and the panel quartered and looked at again while the mesh pays for it.
 *
 * @param moments r f at the points of the load (Load)
 * @param extents those of the space
 * @throws BadInput where f is not finite
 */
ForcePanels choose_force_panels(const RingSpace& space, const Scene& scene,
                                const std::vector<double>& moments, const RadialExtents& extents);

/// N^(-p/2) C ||f|| / 100, N unknowns of degree p, C that of Friedrichs' inequality: an error of
/// the load that is small beside the mesh's own. The panels have to be judged.
double negligible_error_of_force(const RingSpace& space, const Scene& scene,
                                 const ForcePanels& panels);

} // namespace rollwave

#endif
