#ifndef ROLLWAVE_ADAPT_MARKING_H
#define ROLLWAVE_ADAPT_MARKING_H

#include <deal.II/grid/tria.h>

#include <optional>
#include <vector>

namespace rollwave {

struct Scene;

enum class Indicator {
  /// "residual": the residual indicator.
  residual,
  /// "kelly": jumps of the normal derivative, deal.II's KellyErrorEstimator; for comparison.
  kelly
};

enum class Marking {
  /// "bulk": the cells with the largest indicators that hold a fraction of the sum of squares.
  bulk,
  /// "number": a fraction of all cells, those with the largest indicators.
  number,
  /// "all": every cell.
  all
};

/// Adaptive refinement, of section `Mesh`.
struct RefinementOptions {
  std::optional<unsigned int> adaptive_cycles; ///< nullopt: as many as the wanted error needs
  double wanted_relative_error = 0;            ///< 0: none
  Indicator indicator = Indicator::residual;
  Marking marking = Marking::bulk;
  double marked_fraction = 0.6;
};

/// How often a run refines its mesh at most.
unsigned int most_cycles(const RefinementOptions& options);

/// Whether so many more cells fit that a further mesh is worth its solution: a fifth, with
/// Marking::all three times as many as there are.
bool has_room_to_refine(const dealii::Triangulation<2>& triangulation, Marking marking,
                        double most_cells);

/**
 * Cuts the marked cells of @p triangulation in four and shares the cells among the processes anew.
 * @p indicators are the eta_K of its active cells. Bulk marking is that of W. Doerfler (SIAM J.
 * Numer. Anal. 33 (1996) 1106-1124): the fewest cells with sum eta_K^2 >= @p fraction of the whole.
 *
 * With a flat cell those above and below are cut, as far as what varies over its length reaches.
 *
 * When more than @p most_cells active cells would come of it, only the marked cells with the
 * largest indicators are cut, so many as fit. Neighbours differ by one level at most, over the seam
 * as well. Cells of level 29 are not cut: CellId and p4est have no room beyond.
 *
 * @return false, the mesh being left as it is, when no cell is marked or none fits
 */
bool refine_mesh(dealii::Triangulation<2>& triangulation, const Scene& scene,
                 const std::vector<double>& indicators, Marking marking, double fraction,
                 double most_cells);

/// Whether there are cells that cannot be cut again.
bool is_at_finest_level(const dealii::Triangulation<2>& triangulation);

} // namespace rollwave

#endif
