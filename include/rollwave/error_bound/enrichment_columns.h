#ifndef ROLLWAVE_ERROR_BOUND_ENRICHMENT_COLUMNS_H
#define ROLLWAVE_ERROR_BOUND_ENRICHMENT_COLUMNS_H

#include "rollwave/error_bound/radial_shapes.h"
#include "rollwave/mesh/ring_space.h"
#include "rollwave/mesh/tensor_elements.h"
#include "rollwave/solver/banded_cholesky.h"

#include <vector>

namespace rollwave {

/**
 * The quadratic form int (h_z beta g_s)^2 ds dz + int (P g)^2 / r dr dz of AngularEnrichment on the
 * columns of cells that a process has. A column goes from the hub outwards as far as cells of one
 * length follow each other; the values of g in it are rows of a banded matrix, one column after
 * another.
 */
class ColumnForm {
public:
  ColumnForm(const RingSpace& space, unsigned int degree)
      : zero(space.make_field()), degree(degree), matrix(degree), inverse(degree) {}

  /// @param place of a value of g among a field's own and ghost values
  void begin_column(unsigned int place);

  /// The next cell of the column, with the places of its degree + 1 values of g.
  void add_cell(const ShapeProducts& radial, double length, double bubble_square,
                const std::vector<unsigned int>& cell_places);

  unsigned int size() const { return places.size(); }

  /// Keeps g = 0 in a row; after factorise() in the last one of a column. Loads must be 0 there.
  void fix(unsigned int row);

  /// Another process has the rest of the column.
  void cut(unsigned int row) { cuts.push_back(row); }

  /// Prepares solve(), when all columns are there.
  void factorise();

  /// At each place the sum of what the rows of all processes have for it.
  FieldVector add_up(const std::vector<double>& rows) const;

  /// What a field has for each row.
  std::vector<double> rows_of(const FieldVector& field) const;

  /// The minimiser for a load; where columns are cut, to 1e-8 of it or what a hundred steps of
  /// conjugate gradients come to. Any g gives a bound.
  FieldVector solve(const FieldVector& load) const;

  /// By how much the minimiser changes when its values in some last @p rows of columns are given a
  /// @p change.
  FieldVector follow(std::vector<double> change, const std::vector<unsigned int>& rows) const;

  void vmult(FieldVector& result, const FieldVector& g) const;

private:
  /// The inverse of the form without what ties rows at cuts to others: the inverse itself where a
  /// process has whole columns.
  FieldVector precondition(const FieldVector& g) const;

  FieldVector zero;
  unsigned int degree;
  std::vector<unsigned int> places; ///< of the rows
  std::vector<unsigned int> cuts;
  bool is_whole = true; ///< no process has cuts
  BandedMatrix matrix, inverse;
};

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
