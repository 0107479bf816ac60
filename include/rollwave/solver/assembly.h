#pragma once

#include "rollwave/mesh/ring_space.h"
#include "rollwave/solver/system_matrix.h"

#include <vector>

namespace rollwave {

struct Scene;

/**
 * The sum of the matrices of the cells of this process. The sum over all processes is the stiffness
 * matrix
 *
 *     K_ij = a(phi_j, phi_i) = int r (alpha d_z phi_j d_z phi_i + d_r phi_j d_r phi_i) dr dz,
 *     alpha = 1/r^2 - omega^2,
 *
 * by Gauss' rules: exact along z, the factor 1/r to 1e-13. All processes must call it.
 * @param contact_nodes which are parted from the other unknowns
 */
SystemMatrix assemble_stiffness(const RingSpace& space, const Scene& scene,
                                const std::vector<SurfaceNode>& contact_nodes = {});

} // namespace rollwave
