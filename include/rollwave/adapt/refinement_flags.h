#ifndef ROLLWAVE_ADAPT_REFINEMENT_FLAGS_H
#define ROLLWAVE_ADAPT_REFINEMENT_FLAGS_H

#include <deal.II/grid/tria.h>

namespace rollwave {

struct Scene;

/// The number of cells of all processes that are flagged for a cut.
unsigned int count_flagged(const dealii::Triangulation<2>& triangulation);

/// Settles what is flagged, with the neighbours that must be cut too.
void settle_flags(dealii::Triangulation<2>& triangulation);

/// The number of active cells after the refinement that is flagged.
double n_cells_to_come(const dealii::Triangulation<2>& triangulation);

/// Flags the cells of the same level above and below those that are flagged, as far as flagged
/// cells reach. What varies in z like sin(k z) varies in r like exp(+-k int alpha^(1/2) dr); a
/// trace that was finer at one end of flat cells than at the other would have to change within
/// them, at a cost that grows with the square of length over height.
void flag_columns(dealii::Triangulation<2>& triangulation, const Scene& scene);

void clear_flags(dealii::Triangulation<2>& triangulation);

/// Whether there are cells that cannot be cut: CellId and p4est have no room beyond level 29.
bool is_at_finest_level(const dealii::Triangulation<2>& triangulation);

} // namespace rollwave

#endif
