#pragma once

#include "rollwave/mesh/ring_space.h"

#include <deal.II/grid/tria.h>

#include <optional>
#include <vector>

namespace rollwave {

struct Scene;

enum class Indicator {
  /// "certificate": the cells' shares of the error bound. Kelly where no bound is computed.
  certificate,
  /// "kelly": jumps of the normal derivative, deal.II's KellyErrorEstimator.
  kelly
};

enum class Marking {
  /// "bulk": the cells with the largest indicators that hold a fraction of the sum of squares.
  bulk,
  /// "all": every cell.
  all
};

/// Adaptive refinement, of section `Mesh`.
struct RefinementOptions {
  std::optional<unsigned int> adaptive_cycles; ///< nullopt: as many as the wanted error needs
  double wanted_relative_error = 0;            ///< 0: none
  Indicator indicator = Indicator::certificate;
  Marking marking = Marking::bulk;
  double marked_fraction = 0.75;
};

/// How often a run refines its mesh at most.
unsigned int most_cycles(const RefinementOptions& options);

/// True if a run may refine some cells and not others.
bool is_adaptive(const RefinementOptions& options);

/// True if a further mesh is worth its solution although not all marked cells fit: a fifth more
/// cells fit or, with Marking::all, four times as many.
bool has_room_to_refine(const dealii::Triangulation<2>& triangulation,
                        const RefinementOptions& options, double most_cells);

/// Jumps of the normal derivative in (r, b z), a length for each active cell, 0 on cells of other
/// processes. They ignore alpha, the force and the contact.
std::vector<double> kelly_indicator(const RingSpace& space, const FieldVector& field);

/**
 * Cuts the marked cells of @p triangulation in four and shares the cells among the processes anew.
 * @p indicators are the eta_K of its active cells; those of other processes' cells are not used.
 * Bulk marking is that of W. Doerfler (SIAM J. Numer. Anal. 33 (1996) 1106-1124): the fewest cells
 * with sum eta_K^2 >= marked_fraction of the whole, without those below a quarter of the largest
 * indicator. Cells with the same indicator are marked together, so that symmetric scenes keep
 * symmetric meshes, and the mesh does not depend on the number of processes.
 *
 * The fraction is smaller if less of the error has to go, so that it falls to the part @p goal of
 * what it is, or if there would be more than @p most_cells active cells. Neighbours differ by one
 * level at most, over the seam as well. Cells of level 29, the limit of CellId and p4est, are not
 * cut. They count, as part of the whole and for the largest indicator, only if they alone have
 * more error than the goal, or, without a goal, more than the others.
 *
 * @param goal 0 for none
 * @return false, with the mesh as it was, if no cell is marked or no marked cell fits
 */
bool refine_mesh(dealii::Triangulation<2>& triangulation, const Scene& scene,
                 const std::vector<double>& indicators, double goal,
                 const RefinementOptions& options, double most_cells);

/// True if there are cells that cannot be cut again.
bool is_at_finest_level(const dealii::Triangulation<2>& triangulation);

} // namespace rollwave
