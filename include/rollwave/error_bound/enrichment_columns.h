#ifndef ROLLWAVE_ERROR_BOUND_ENRICHMENT_COLUMNS_H
#define ROLLWAVE_ERROR_BOUND_ENRICHMENT_COLUMNS_H

#include "rollwave/error_bound/column_form.h"
#include "rollwave/error_bound/radial_shapes.h"

#include <vector>

namespace rollwave {

/// The columns of cells on which AngularEnrichment stand, which depend on mesh and speed alone.
struct EnrichmentColumns {
  EnrichmentColumns(const RingSpace& space, RadialShapesOfMesh& shapes);

  /// A row of the form at an edge of RingSpace::surface_faces().
  struct SurfaceRow {
    unsigned int row, edge;
  };

  ColumnForm form;                      ///< with g free on r = b, factorised
  std::vector<unsigned int> first_rows; ///< of each active cell that the process has
  std::vector<unsigned int> fixed_rows; ///< where g = 0
  std::vector<SurfaceRow> surface_rows;
};

/// The number on a cell, the radial index running fastest, of the node that carries g at the radial
/// node @p i of @p n: neighbours over a radial line have it in common, neighbours in z do not.
unsigned int bubble_carrier(unsigned int i, unsigned int n);

} // namespace rollwave

#endif
