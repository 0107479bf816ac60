#include "refinement.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/p4est_wrappers.h>
#include <deal.II/grid/grid_refinement.h>
#include <deal.II/grid/tria.h>
#include <deal.II/numerics/error_estimator.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace rollwave {

using namespace dealii;

std::vector<double> kelly_indicator(const RingSpace& space, const FieldVector& field) {
  Vector<float> indicators(space.dof_handler().get_triangulation().n_active_cells());
  KellyErrorEstimator<2>::estimate(space.mapping(), space.dof_handler(),
                                   QGauss<1>(space.dof_handler().get_fe().degree + 1), {}, field,
                                   indicators);
  return {indicators.begin(), indicators.end()};
}

namespace {

/// A cell that is longer than high by this factor counts as flat.
constexpr double flat_cell = 8;

constexpr int finest_level = internal::p4est::functions<2>::max_level - 1;

/// Settles what is flagged, with the neighbours that must be cut too.
void prepare(Triangulation<2>& triangulation) {
  for (const auto& cell : triangulation.active_cell_iterators())
    if (cell->level() == finest_level)
      cell->clear_refine_flag();
  triangulation.prepare_coarsening_and_refinement();
}

/// The number of active cells after the refinement that is flagged.
unsigned int n_cells_to_come(const Triangulation<2>& triangulation) {
  unsigned int flagged = 0;
  for (const auto& cell : triangulation.active_cell_iterators())
    flagged += cell->refine_flag_set() ? 1 : 0; // a refinement case, not a bool
  return triangulation.n_active_cells() + 3 * flagged;
}

/// Flags the cells above and below a flagged one of their level, from hub to surface.
void flag_column(const Triangulation<2>::active_cell_iterator& cell) {
  for (const unsigned int face : {0U, 1U})
    for (auto next = cell; !next->at_boundary(face) && next->neighbor(face)->is_active() &&
                           next->neighbor(face)->level() == cell->level();) {
      next = next->neighbor(face);
      next->set_refine_flag();
    }
}

/// Flags the cells from the value @p last_marked on. Mirror images have the same indicator but for
/// round-off, which shall not choose between them. Where cells are flat, all of a column are
/// flagged: u and the dual potential hardly vary over the height of such a cell but for what its
/// ends impose, and a trace that is finer at one end than at the other would have to change within
/// it, at a cost that grows with the square of length over height.
void flag(Triangulation<2>& triangulation, const Vector<double>& squares, double last_marked) {
  for (const auto& cell : triangulation.active_cell_iterators())
    if (squares(cell->active_cell_index()) >= (1 - 1e-6) * last_marked) {
      cell->set_refine_flag();
      const Tensor<1, 2> size = cell->vertex(3) - cell->vertex(0);
      if (cell->center()[0] * size[1] > flat_cell * size[0])
        flag_column(cell);
    }
}

void clear_flags(Triangulation<2>& triangulation) {
  for (const auto& cell : triangulation.active_cell_iterators())
    cell->clear_refine_flag();
}

/// Flags the cells for coarsening whose parents, of which they have the fraction @p left_to_part of
/// the squares each, would have less than @p most.
void flag_too_fine(Triangulation<2>& triangulation, const Vector<double>& squares, double most,
                   double left_to_part) {
  for (const auto& cell : triangulation.active_cell_iterators())
    if (cell->level() > 0 && squares(cell->active_cell_index()) < left_to_part * most)
      cell->set_coarsen_flag();
}

/// Flags the cells with the largest values among those from @p last_marked on, so many that the
/// mesh will have @p most_cells cells at most, or none when they would be too few to matter.
/// Returns the value of the last.
double flag_as_many_as_fit(Triangulation<2>& triangulation, const Vector<double>& squares,
                           double last_marked, double most_cells) {
  std::vector<double> marked;
  for (const double square : squares)
    if (square >= last_marked)
      marked.push_back(square);
  std::sort(marked.begin(), marked.end(), std::greater<>());
  const double n_now = triangulation.n_active_cells();
  for (double n_marked = marked.size();;) {
    // Neighbours that must be cut too come on top of the marked cells.
    n_marked *= 0.98 * (most_cells - n_now) / (n_cells_to_come(triangulation) - n_now);
    clear_flags(triangulation);
    if (n_marked < 1 || n_marked < 0.003 * n_now)
      return last_marked;
    last_marked = marked[static_cast<std::size_t>(n_marked) - 1];
    flag(triangulation, squares, last_marked);
    prepare(triangulation);
    if (n_cells_to_come(triangulation) <= most_cells)
      return last_marked;
  }
}

/// Cuts and coarsens flagged cells; each part inherits its cell's square times @p left_to_part, a
/// cell that is whole again that of a part over the same number.
void execute(Triangulation<2>& triangulation, Vector<double>& squares, double left_to_part) {
  triangulation.clear_user_data();
  for (const auto& cell : triangulation.active_cell_iterators()) {
    cell->set_user_index(cell->active_cell_index() + 1);
    if (cell->coarsen_flag_set()) {
      cell->parent()->set_user_index(cell->active_cell_index() + 1);
      squares(cell->active_cell_index()) /= left_to_part;
    }
  }
  triangulation.execute_coarsening_and_refinement();
  Vector<double> inherited(triangulation.n_active_cells());
  for (const auto& cell : triangulation.active_cell_iterators())
    inherited(cell->active_cell_index()) =
        cell->user_index() > 0 ? squares(cell->user_index() - 1)
                               : left_to_part * squares(cell->parent()->user_index() - 1);
  squares = inherited;
}

} // namespace

bool is_at_finest_level(const Triangulation<2>& triangulation) {
  return triangulation.n_levels() > finest_level;
}

bool refine_mesh(Triangulation<2>& triangulation, const std::vector<double>& indicators,
                 Marking marking, double fraction, unsigned int degree, double most_cells,
                 bool coarsens) {
  Vector<double> squares(indicators.size());
  const double largest = *std::max_element(indicators.begin(), indicators.end());
  for (unsigned int i = 0; i < indicators.size() && largest > 0; ++i)
    squares(i) = indicators[i] / largest * (indicators[i] / largest);
  switch (marking) {
  case Marking::bulk:
    GridRefinement::refine_and_coarsen_fixed_fraction(triangulation, squares, fraction, 0.);
    break;
  case Marking::number:
    GridRefinement::refine_and_coarsen_fixed_number(triangulation, squares, fraction, 0.);
    break;
  case Marking::all:
    break;
  }
  double last_marked = std::numeric_limits<double>::infinity();
  for (const auto& cell : triangulation.active_cell_iterators())
    if (cell->refine_flag_set())
      last_marked = std::min(last_marked, squares(cell->active_cell_index()));
  const double left_to_part = std::pow(4., -(degree + 1.));
  bool is_changed = false;
  if (coarsens) {
    clear_flags(triangulation);
    flag_too_fine(triangulation, squares, last_marked / 2, left_to_part);
    prepare(triangulation);
    const unsigned int n_before = triangulation.n_active_cells();
    execute(triangulation, squares, left_to_part);
    is_changed = triangulation.n_active_cells() != n_before;
  }
  if (marking == Marking::all)
    triangulation.set_all_refine_flags();
  else if (last_marked > 0)
    flag(triangulation, squares, last_marked);
  prepare(triangulation);
  if (n_cells_to_come(triangulation) > most_cells) {
    if (marking == Marking::all) {
      clear_flags(triangulation);
      return is_changed;
    }
    last_marked = flag_as_many_as_fit(triangulation, squares, last_marked, most_cells);
  }
  if (n_cells_to_come(triangulation) == triangulation.n_active_cells())
    return is_changed;
  execute(triangulation, squares, left_to_part);
  while (marking != Marking::all && last_marked > 0) {
    for (const auto& cell : triangulation.active_cell_iterators())
      if (cell->user_index() == 0 && squares(cell->active_cell_index()) > last_marked)
        cell->set_refine_flag();
    prepare(triangulation);
    const unsigned int n_next = n_cells_to_come(triangulation);
    if (n_next == triangulation.n_active_cells() || n_next > most_cells)
      break;
    execute(triangulation, squares, left_to_part);
  }
  return true;
}

} // namespace rollwave
