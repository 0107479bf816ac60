#pragma once

#include "rollwave/parameters/output_options.h"
#include "rollwave/run/simulation.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace rollwave {

/**
 * Writes the deformed cylinder as VTU, in x = (r + u) cos z, y = (r + u) sin z, where a flat road
 * is the line y = -c. Point fields: `displacement` u and, in x and y, `displacement_vector`, both
 * lengths; `radial_stress` u_r; `radius` r and `angle` z, the undeformed coordinates. On each cell,
 * where there is a certificate: `certified_error`, eta of the cell. Of the whole: `omega`, `c`,
 * `F`. Elements of degree p become VTK's Lagrange cells with (p + 1)^2 nodes, or p^2 linear cells.
 * A failure to write is left in the state of the stream.
 *
 * Each process writes its own cells, and must have at least one.
 */
void write_solution_vtu(std::ostream& out, const Solution& solution, CellKind kind);

/// Writes the file that holds together the @p pieces, the names of all processes' files.
void write_solution_pvtu(std::ostream& out, const Solution& solution, CellKind kind,
                         const std::vector<std::string>& pieces);

} // namespace rollwave
