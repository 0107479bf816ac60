#include "rollwave/adapt/refinement_flags.h"

#include "rollwave/base/mpi_processes.h"
#include "rollwave/scene/scene.h"

#include <deal.II/distributed/p4est_wrappers.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

namespace rollwave {

using namespace dealii;

namespace {

/// How deep what changes its sign from one cell to the next reaches in int alpha^(1/2) dr, as a
/// share of their length: to exp(-3 pi / 4), a tenth.
constexpr double reach_of_length = 0.75;

constexpr int finest_level = internal::p4est::functions<2>::max_level - 1;

using Cell = Triangulation<2>::active_cell_iterator;

} // namespace

unsigned int count_flagged(const Triangulation<2>& triangulation) {
  unsigned int flagged = 0;
  for (const auto& cell : triangulation.active_cell_iterators())
    flagged += cell->is_locally_owned() && cell->refine_flag_set();
  return Utilities::MPI::sum(flagged, triangulation.get_communicator());
}

namespace {

/// Gives the cells next to those of a process the flags that their own processes have set.
void exchange_flags(Triangulation<2>& triangulation) {
  GridTools::exchange_cell_data_to_ghosts<int, Triangulation<2>>(
      triangulation, [](const Cell& cell) -> std::optional<int> { return cell->refine_flag_set(); },
      [](const Cell& cell, int is_flagged) {
        cell->clear_refine_flag();
        if (is_flagged)
          cell->set_refine_flag();
      });
}

/// Flags cells so that those on both sides of the seam that touch in a vertex will be no more than
/// a level apart: p4est sees to that, a mesh on one process does so for cells that share a line.
/// @returns whether there were any.
bool balance_seam(Triangulation<2>& triangulation) {
  const auto level_to_come = [](const Cell& cell) {
    return cell->level() + (cell->refine_flag_set() ? 1 : 0);
  };
  const auto visit_vertices = [&](const auto& visit) {
    for (const auto& cell : triangulation.active_cell_iterators())
      for (const unsigned int face : {2U, 3U})
        if (cell->at_boundary(face))
          for (const unsigned int vertex : {0U, 1U})
            visit(cell, cell->face(face)->vertex(vertex)[0]);
  };
  std::map<double, int> finest;
  visit_vertices(
      [&](const Cell& cell, double r) { finest[r] = std::max(finest[r], level_to_come(cell)); });
  bool is_changed = false;
  visit_vertices([&](const Cell& cell, double r) {
    if (finest[r] <= level_to_come(cell) + 1)
      return;
    is_changed = true;
    cell->set_refine_flag();
  });
  return is_changed;
}

} // namespace

void settle_flags(Triangulation<2>& triangulation) {
  for (const auto& cell : triangulation.active_cell_iterators())
    if (cell->level() == finest_level)
      cell->clear_refine_flag();
  if (is_alone(triangulation.get_communicator())) {
    do
      triangulation.prepare_coarsening_and_refinement();
    while (balance_seam(triangulation));
    return;
  }
  unsigned int n_before;
  do {
    n_before = count_flagged(triangulation);
    exchange_flags(triangulation);
    triangulation.prepare_coarsening_and_refinement();
  } while (count_flagged(triangulation) != n_before);
}

double n_cells_to_come(const Triangulation<2>& triangulation) {
  return triangulation.n_global_active_cells() + 3. * count_flagged(triangulation);
}

namespace {

/// Gives the cells next to those of a process what their own processes have for them.
void exchange_values(const Triangulation<2>& triangulation, std::vector<double>& of_cells) {
  if (is_alone(triangulation.get_communicator()))
    return;
  GridTools::exchange_cell_data_to_ghosts<double, Triangulation<2>>(
      triangulation,
      [&](const Cell& cell) -> std::optional<double> {
        return of_cells[cell->active_cell_index()];
      },
      [&](const Cell& cell, double value) { of_cells[cell->active_cell_index()] = value; });
}

} // namespace

void flag_columns(Triangulation<2>& triangulation, const Scene& scene) {
  const MPI_Comm communicator = triangulation.get_communicator();
  const auto depth = [&scene](const Cell& cell) {
    const double height = cell->vertex(3)[0] - cell->vertex(0)[0];
    return height * std::sqrt(std::max(0., scene.alpha(cell->center()[0])));
  };
  for (const unsigned int face : {0U, 1U}) {
    std::vector<double> reach(triangulation.n_active_cells()); // beyond the cell
    for (const auto& cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && cell->refine_flag_set())
        reach[cell->active_cell_index()] =
            reach_of_length * (cell->vertex(3)[1] - cell->vertex(0)[1]) - depth(cell);
    bool is_settled;
    do { // as often as a column passes from one process to another
      is_settled = true;
      exchange_values(triangulation, reach);
      for (const auto& cell : triangulation.active_cell_iterators()) {
        if (cell->is_artificial())
          continue;
        auto next = cell;
        for (double left = reach[cell->active_cell_index()];
             left > 0 && !next->at_boundary(face) && next->neighbor(face)->is_active() &&
             next->neighbor(face)->level() == cell->level() &&
             next->neighbor(face)->is_locally_owned();) {
          next = next->neighbor(face);
          next->set_refine_flag();
          left -= depth(next);
          if (left <= reach[next->active_cell_index()])
            break;
          reach[next->active_cell_index()] = left;
          is_settled = false;
        }
      }
    } while (Utilities::MPI::min<int>(is_settled, communicator) == 0);
  }
}

void clear_flags(Triangulation<2>& triangulation) {
  for (const auto& cell : triangulation.active_cell_iterators())
    cell->clear_refine_flag();
}

bool is_at_finest_level(const Triangulation<2>& triangulation) {
  return triangulation.n_global_levels() > finest_level;
}

} // namespace rollwave
