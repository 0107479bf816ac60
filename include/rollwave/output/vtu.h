#pragma once

#include "rollwave/parameters/output_options.h"
#include "rollwave/run/simulation.h"

#include <string>

namespace rollwave {

/**
 * The deformed cylinder as VTU, in x = (r + u) cos z, y = (r + u) sin z, where a flat road is the
 * line y = -c. Point fields: `displacement` u and, in x and y, `displacement_vector`, both lengths;
 * `radial_stress` u_r; `radius` r and `angle` z, the undeformed coordinates. On each cell, where
 * there is a certificate: `certified_error`, eta of the cell. Of the whole: `omega`, `c`, `F`.
 * Elements of degree p become VTK's Lagrange cells with (p + 1)^2 nodes, or p^2 linear cells.
 *
 * Each process gets its part of the file, in the order of their ranks: a piece if it has cells.
 */
std::string solution_vtu(const Solution& solution, CellKind kind);

} // namespace rollwave
