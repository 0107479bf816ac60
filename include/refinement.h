#ifndef ROLLWAVE_REFINEMENT_H
#define ROLLWAVE_REFINEMENT_H

#include "parameters.h"
#include "ring_space.h"

#include <vector>

namespace rollwave {

/// Jumps of the normal derivative, deal.II's KellyErrorEstimator, for each active cell. It ignores
/// alpha, the force and the contact; for comparison only.
std::vector<double> kelly_indicator(const RingSpace& space, const FieldVector& field);

/**
 * Flags the cells of @p triangulation to refine by the indicators eta_K of its active cells. Bulk
 * marking is that of W. Doerfler (SIAM J. Numer. Anal. 33 (1996) 1106-1124): the fewest cells with
 * sum eta_K^2 >= @p fraction of the whole.
 *
 * @return the number of active cells after the refinement, with the cells that must follow so that
 *         neighbours differ by one level at most
 */
unsigned int mark_cells(dealii::Triangulation<2>& triangulation,
                        const std::vector<double>& indicators, Marking marking, double fraction);

} // namespace rollwave

#endif
