#ifndef ROLLWAVE_OUTPUT_VTU_H
#define ROLLWAVE_OUTPUT_VTU_H

#include "rollwave/run/solution.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace rollwave {

/**
 * Writes the deformed cylinder as VTU, in x = (r + u) cos z, y = (r + u) sin z, where the road is
 * the line y = -c. Point fields: `displacement` u, a length, and `pressure` lambda on the surface,
 * zero off the contact zone and not a number inside of the cylinder, where there is none. On each
 * cell, where there is a certificate: `certified_error`, eta of the cell. Elements
 * of degree p become VTK's Lagrange cells with (p + 1)^2 nodes. A failure to write is left in the
 * state of the stream.
 *
 * Of several processes each writes its own cells. @p unit is what the unit of the scene is to be
 * written as.
 */
void write_solution_vtu(std::ostream& out, const Solution& solution, double unit);

/// Writes the file that holds together the @p pieces, the names of all processes' files.
void write_solution_pvtu(std::ostream& out, const Solution& solution,
                         const std::vector<std::string>& pieces);

} // namespace rollwave

#endif
