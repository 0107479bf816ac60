#pragma once

#include "rollwave/error_bound/radial_shapes.h"
#include "rollwave/mesh/assembly.h"

namespace rollwave {

/**
 * The cells of the form that the potential of a flux minimises,
 *
 *     int psi_s chi_s ds dz + int psi_z chi_z / r dr dz,   ds = r alpha dr.
 *
 * On a cell, potentials are products R(r) Z(z) of radial shapes and polynomials, so that its matrix
 * is a sum of two products of one-dimensional ones, which costs less than quadrature on the cell.
 * @param space and shapes must stay valid while the cells are asked for
 */
CellMatrices dual_matrices(const RingSpace& space, RadialShapesOfMesh& shapes);

} // namespace rollwave
