#include "rollwave/adapt/marking.h"

#include "rollwave/base/mpi_processes.h"
#include "rollwave/scene/scene.h"

#include <deal.II/distributed/p4est_wrappers.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace rollwave {

using namespace dealii;

unsigned int most_cycles(const RefinementOptions& options) {
  return options.adaptive_cycles.value_or(
      options.wanted_relative_error > 0 ? std::numeric_limits<unsigned int>::max() : 0);
}

bool has_room_to_refine(const Triangulation<2>& triangulation, Marking marking, double most_cells) {
  const double least_growth = marking == Marking::all ? 4 : 1.2;
  return least_growth * triangulation.n_global_active_cells() <= most_cells;
}

namespace {

constexpr int finest_level = internal::p4est::functions<2>::max_level - 1;

using MeshCell = Triangulation<2>::active_cell_iterator;

/// The indicators of the cells of all processes, the largest first.
std::vector<double> gather_sorted(const Triangulation<2>& triangulation,
                                  const std::vector<double>& indicators) {
  std::vector<double> own, all;
  for (const auto& cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      own.push_back(indicators[cell->active_cell_index()]);
  for (const auto& some : Utilities::MPI::all_gather(triangulation.get_communicator(), own))
    all.insert(all.end(), some.begin(), some.end());
  std::sort(all.begin(), all.end(), std::greater<double>());
  return all;
}

/// How many of the largest indicators are marked.
std::size_t count_marked(const std::vector<double>& sorted, Marking marking, double fraction) {
  if (marking == Marking::all)
    return sorted.size();
  if (sorted.front() == 0)
    return 0;
  if (marking == Marking::number)
    return std::ceil(fraction * sorted.size());
  const auto square = [&](double indicator) { return std::pow(indicator / sorted.front(), 2); };
  double wanted = 0;
  for (const double indicator : sorted)
    wanted += fraction * square(indicator);
  std::size_t count = 0;
  for (double sum = 0; sum < wanted && count < sorted.size(); ++count)
    sum += square(sorted[count]);
  return count;
}

/// Gives the cells next to those of a process the numbers that their own processes have for them.
void exchange_to_ghosts(const Triangulation<2>& triangulation, std::vector<double>& of_cells) {
  if (is_alone(triangulation.get_communicator()))
    return;
  GridTools::exchange_cell_data_to_ghosts<double, Triangulation<2>>(
      triangulation,
      [&](const MeshCell& cell) -> std::optional<double> {
        return of_cells[cell->active_cell_index()];
      },
      [&](const MeshCell& cell, double number) { of_cells[cell->active_cell_index()] = number; });
}

/// Flags the cells of the same level above and below those that are flagged, as far as flagged
/// cells reach. What varies in z like sin(k z) varies in r like exp(+-k int alpha^(1/2) dr): cells
/// longer than that would have to turn one trace into another within them, at a high cost.
void flag_columns(Triangulation<2>& triangulation, const Scene& scene) {
  // To exp(-3 pi / 4), a tenth, of what changes its sign from one cell to the next.
  constexpr double reach_of_length = 0.75;
  const auto depth = [&scene](const MeshCell& cell) {
    const double height = cell->vertex(3)[0] - cell->vertex(0)[0];
    return height * std::sqrt(std::max(0., scene.alpha(cell->center()[0])));
  };
  for (const unsigned int face : {0U, 1U}) {
    std::vector<double> reach(triangulation.n_active_cells()); // beyond the cell
    for (const auto& cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && cell->refine_flag_set())
        reach[cell->active_cell_index()] =
            reach_of_length * (cell->vertex(3)[1] - cell->vertex(0)[1]) - depth(cell);
    int is_settled;
    do {
      is_settled = 1;
      exchange_to_ghosts(triangulation, reach);
      for (const auto& cell : triangulation.active_cell_iterators()) {
        const double from_here = reach[cell->active_cell_index()];
        if (from_here <= 0 || cell->at_boundary(face))
          continue;
        const auto next = cell->neighbor(face);
        if (next->has_children() || next->level() != cell->level() || !next->is_locally_owned())
          continue;
        next->set_refine_flag();
        double& from_next = reach[next->active_cell_index()];
        if (from_here - depth(next) > from_next) {
          from_next = from_here - depth(next);
          is_settled = 0;
        }
      }
    } while (Utilities::MPI::min(is_settled, triangulation.get_communicator()) == 0);
  }
}

/// Settles with which neighbours the flagged cells must be cut.
/// @return the number of flagged cells of all processes
double settle_flags(Triangulation<2>& triangulation) {
  std::vector<double> is_flagged(triangulation.n_active_cells());
  for (double count = -1;;) { // until no process has more to pass on
    for (const auto& cell : triangulation.active_cell_iterators())
      is_flagged[cell->active_cell_index()] = cell->refine_flag_set();
    exchange_to_ghosts(triangulation, is_flagged);
    for (const auto& cell : triangulation.active_cell_iterators())
      if (is_flagged[cell->active_cell_index()] > 0)
        cell->set_refine_flag();
    triangulation.prepare_coarsening_and_refinement();
    double own = 0;
    for (const auto& cell : triangulation.active_cell_iterators())
      own += cell->is_locally_owned() && cell->refine_flag_set();
    const double before = count;
    count = Utilities::MPI::sum(own, triangulation.get_communicator());
    if (count == before)
      return count;
  }
}

/// Flags the cells with indicators from @p least on, and those that must be cut with them.
/// @return the number of flagged cells of all processes
double flag(Triangulation<2>& triangulation, const Scene& scene,
            const std::vector<double>& indicators, double least) {
  for (const auto& cell : triangulation.active_cell_iterators()) {
    cell->clear_refine_flag();
    // Mirror images have the same indicator but for round-off, which shall not choose.
    if (cell->is_locally_owned() && cell->level() < finest_level &&
        indicators[cell->active_cell_index()] >= (1 - 1e-6) * least)
      cell->set_refine_flag();
  }
  flag_columns(triangulation, scene);
  return settle_flags(triangulation);
}

} // namespace

bool refine_mesh(Triangulation<2>& triangulation, const Scene& scene,
                 const std::vector<double>& indicators, Marking marking, double fraction,
                 double most_cells) {
  const std::vector<double> sorted = gather_sorted(triangulation, indicators);
  const double most_flagged = (most_cells - triangulation.n_global_active_cells()) / 3;
  double n_flagged = 0;
  for (double n_marked = count_marked(sorted, marking, fraction); n_marked >= 1;) {
    n_flagged = flag(triangulation, scene, indicators, sorted[n_marked - 1]);
    if (n_flagged <= most_flagged)
      break;
    // Neighbours that must be cut too come on top of the marked cells.
    n_marked = marking == Marking::all
                   ? 0
                   : std::floor(0.98 * n_marked * std::max(0., most_flagged) / n_flagged);
    n_flagged = 0;
  }
  if (n_flagged == 0) {
    for (const auto& cell : triangulation.active_cell_iterators())
      cell->clear_refine_flag();
    return false;
  }
  triangulation.execute_coarsening_and_refinement();
  if (auto* const shared = dynamic_cast<parallel::distributed::Triangulation<2>*>(&triangulation))
    shared->repartition();
  return true;
}

bool is_at_finest_level(const Triangulation<2>& triangulation) {
  return triangulation.n_global_levels() > finest_level;
}

} // namespace rollwave
