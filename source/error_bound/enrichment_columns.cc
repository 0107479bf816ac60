#include "rollwave/error_bound/enrichment_columns.h"

#include "rollwave/error_bound/angular_enrichment.h"
#include "rollwave/mesh/lexicographic_dofs.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace rollwave {

using namespace dealii;

namespace {

using ColumnCell = DoFHandler<2>::active_cell_iterator;

/// Whether the neighbour of a cell over its face @p f towards the hub or the surface is as long.
bool has_equal_neighbour(const ColumnCell& cell, unsigned int f) {
  if (cell->at_boundary(f))
    return false;
  const auto neighbour = cell->neighbor(f);
  return neighbour->level() == cell->level() && neighbour->is_active();
}

/// Whether a process has the neighbour over the face @p f too, and it is as long.
bool has_own_neighbour(const ColumnCell& cell, unsigned int f) {
  return has_equal_neighbour(cell, f) && cell->neighbor(f)->is_locally_owned();
}

/// int beta^2 dt
double bubble_square(unsigned int degree) {
  const auto bubble = AngularEnrichment::mode(degree).primitive();
  const QGauss<1> gauss(degree + 2);
  double square = 0;
  for (unsigned int q = 0; q < gauss.size(); ++q)
    square += gauss.weight(q) * std::pow(bubble.value(gauss.point(q)[0]), 2);
  return square;
}

} // namespace

unsigned int bubble_carrier(unsigned int i, unsigned int n) {
  return n > 2 ? i + n : i;
}

EnrichmentColumns::EnrichmentColumns(const RingSpace& space, RadialShapesOfMesh& shapes)
    : form(space, space.dof_handler().get_fe().degree),
      first_rows(space.dof_handler().get_triangulation().n_active_cells()) {
  const unsigned int degree = space.dof_handler().get_fe().degree, n = degree + 1;
  const double square = bubble_square(degree);
  const FieldVector field = space.make_field();
  LexicographicDofs dofs(space.dof_handler());
  std::vector<unsigned int> places(n);
  for (ColumnCell cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned() || has_own_neighbour(cell, 0))
      continue;
    const bool is_cut_below = has_equal_neighbour(cell, 0);
    const bool is_fixed_below = !cell->at_boundary(0) && !is_cut_below;
    const unsigned int first_row = form.size();
    for (bool is_first = true;; is_first = false) {
      const auto& of_cell = dofs.of(cell);
      for (unsigned int i = 0; i < n; ++i)
        places[i] = field.get_partitioner()->global_to_local(of_cell[bubble_carrier(i, n)]);
      if (is_first)
        form.begin_column(places[0]);
      const Point<2> low = cell->vertex(0), high = cell->vertex(3);
      first_rows[cell->active_cell_index()] = form.size() - 1;
      form.add_cell(shapes.on(low[0], high[0]).products, high[1] - low[1], square, places);
      if (!has_own_neighbour(cell, 1))
        break;
      cell = cell->neighbor(1);
    }
    const unsigned int last_row = form.size() - 1;
    const bool is_cut_above = has_equal_neighbour(cell, 1);
    if (is_fixed_below)
      fixed_rows.push_back(first_row);
    if (is_cut_below)
      form.cut(first_row);
    if (const auto edge = space.surface_face(cell))
      surface_rows.push_back({last_row, *edge});
    else if (is_cut_above)
      form.cut(last_row);
    else
      fixed_rows.push_back(last_row);
  }
  for (const unsigned int row : fixed_rows)
    form.fix(row);
  form.factorise();
}

} // namespace rollwave
