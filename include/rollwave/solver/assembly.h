#pragma once

#include "rollwave/mesh/ring_space.h"

namespace rollwave {

class SystemMatrix;
struct Scene;

/**
 * Adds the cells of this process to the stiffness matrix
 *
 *     K_ij = a(phi_j, phi_i) = int r (alpha d_z phi_j d_z phi_i + d_r phi_j d_r phi_i) dr dz,
 *     alpha = 1/r^2 - omega^2,
 *
 * by Gauss' rules: exact along z, the factor 1/r to 1e-13.
 */
void assemble_stiffness(const RingSpace& space, const Scene& scene, SystemMatrix& matrix);

} // namespace rollwave
