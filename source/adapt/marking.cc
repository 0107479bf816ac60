#include "rollwave/adapt/marking.h"

#include "rollwave/base/mpi_processes.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/p4est_wrappers.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/numerics/error_estimator.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <vector>

namespace rollwave {

using namespace dealii;

unsigned int most_cycles(const RefinementOptions& options) {
  return options.adaptive_cycles.value_or(
      options.wanted_relative_error > 0 ? std::numeric_limits<unsigned int>::max() : 0);
}

std::vector<double> kelly_indicator(const RingSpace& space, const FieldVector& field) {
  Vector<float> indicators(space.dof_handler().get_triangulation().n_active_cells());
  KellyErrorEstimator<2>::estimate(space.mapping(), space.dof_handler(),
                                   QGauss<1>(space.dof_handler().get_fe().degree + 1), {}, field,
                                   indicators);
  return {indicators.begin(), indicators.end()};
}

namespace {

/// How deep what changes its sign from one cell to the next reaches in int alpha^(1/2) dr, as a
/// share of their length: to exp(-3 pi / 4), a tenth.
constexpr double reach_of_length = 0.75;

constexpr int finest_level = internal::p4est::functions<2>::max_level - 1;

using Cell = Triangulation<2>::active_cell_iterator;

/// The number of cells of all processes that are flagged for a cut.
unsigned int count_flagged(const Triangulation<2>& triangulation) {
  unsigned int flagged = 0;
  for (const auto& cell : triangulation.active_cell_iterators())
    flagged += cell->is_locally_owned() && cell->refine_flag_set();
  return Utilities::MPI::sum(flagged, triangulation.get_communicator());
}

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

/// Settles what is flagged, with the neighbours that must be cut too.
void prepare(Triangulation<2>& triangulation) {
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

/// The number of active cells after the refinement that is flagged.
double n_cells_to_come(const Triangulation<2>& triangulation) {
  return triangulation.n_global_active_cells() + 3. * count_flagged(triangulation);
}

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

/// Flags the cells of the same level above and below those that are flagged, as far as flagged
/// cells reach. What varies in z like sin(k z) varies in r like exp(+-k int alpha^(1/2) dr); a
/// trace that was finer at one end of flat cells than at the other would have to change within
/// them, at a cost that grows with the square of length over height.
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

/// Flags the cells from the value @p last_marked on. Mirror images have the same indicator but for
/// round-off, which shall not choose between them.
void flag(Triangulation<2>& triangulation, const Scene& scene, const Vector<double>& squares,
          double last_marked) {
  for (const auto& cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && squares(cell->active_cell_index()) >= (1 - 1e-6) * last_marked)
      cell->set_refine_flag();
  flag_columns(triangulation, scene);
}

void clear_flags(Triangulation<2>& triangulation) {
  for (const auto& cell : triangulation.active_cell_iterators())
    cell->clear_refine_flag();
}

/// The squares of the own cells.
std::vector<double> own_squares(const Triangulation<2>& triangulation,
                                const Vector<double>& squares) {
  std::vector<double> own;
  for (const auto& cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      own.push_back(squares(cell->active_cell_index()));
  return own;
}

/// The last of the largest values, at most 1, of all processes that add up to @p share in @p
/// weight: what all from there on weigh. Found by bisection, the same way on one process and on
/// many, but for ties.
template <typename Weight>
double last_of_share(const std::vector<double>& values, const Weight& weight, double share,
                     MPI_Comm communicator) {
  const auto weight_from = [&](double least) {
    double sum = 0;
    for (const double value : values)
      if (value >= least)
        sum += weight(value);
    return Utilities::MPI::sum(sum, communicator);
  };
  double low = 1e-300, high = 1;
  if (weight_from(high) >= share)
    return high;
  for (int halving = 0; halving < 64; ++halving) {
    const double middle = std::sqrt(low) * std::sqrt(high);
    (weight_from(middle) >= share ? low : high) = middle;
  }
  double last = high;
  for (const double value : values)
    if (value >= low)
      last = std::min(last, value);
  return Utilities::MPI::min(last, communicator);
}

/// Flags the cells with the largest values among those from @p last_marked on, so many that the
/// mesh will have @p most_cells cells at most. Returns the value of the last.
double flag_as_many_as_fit(Triangulation<2>& triangulation, const Scene& scene,
                           const Vector<double>& squares, double last_marked, double most_cells) {
  const MPI_Comm communicator = triangulation.get_communicator();
  const std::vector<double> own = own_squares(triangulation, squares);
  const double n_now = triangulation.n_global_active_cells();
  double n_marked = Utilities::MPI::sum(
      double(std::count_if(own.begin(), own.end(),
                           [last_marked](double square) { return square >= last_marked; })),
      communicator);
  for (;;) {
    // Neighbours that must be cut too come on top of the marked cells.
    n_marked *= 0.98 * (most_cells - n_now) / (n_cells_to_come(triangulation) - n_now);
    clear_flags(triangulation);
    if (n_marked < 1)
      return last_marked;
    last_marked = last_of_share(
        own, [](double) { return 1.; }, std::floor(n_marked), communicator);
    flag(triangulation, scene, squares, last_marked);
    prepare(triangulation);
    if (n_cells_to_come(triangulation) <= most_cells)
      return last_marked;
  }
}

/// Cuts flagged cells; each part inherits its cell's square times @p left_to_part.
void execute(Triangulation<2>& triangulation, Vector<double>& squares, double left_to_part) {
  triangulation.clear_user_data();
  for (const auto& cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      cell->set_user_index(cell->active_cell_index() + 1);
  triangulation.execute_coarsening_and_refinement();
  Vector<double> inherited(triangulation.n_active_cells());
  for (const auto& cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      inherited(cell->active_cell_index()) =
          cell->user_index() > 0 ? squares(cell->user_index() - 1)
                                 : left_to_part * squares(cell->parent()->user_index() - 1);
  squares = inherited;
}

/// Refines as refine_mesh(), without giving cells to other processes.
bool refine_in_place(Triangulation<2>& triangulation, const Scene& scene,
                     const std::vector<double>& indicators, Marking marking, double fraction,
                     unsigned int degree, double most_cells) {
  const MPI_Comm communicator = triangulation.get_communicator();
  Vector<double> squares(indicators.size());
  const double largest =
      Utilities::MPI::max(*std::max_element(indicators.begin(), indicators.end()), communicator);
  for (unsigned int i = 0; i < indicators.size() && largest > 0; ++i)
    squares(i) = indicators[i] / largest * (indicators[i] / largest);
  double last_marked = std::numeric_limits<double>::infinity();
  if (largest > 0 && fraction > 0 && marking != Marking::all) {
    const std::vector<double> own = own_squares(triangulation, squares);
    const auto count = [](double) { return 1.; };
    const auto value = [](double square) { return square; };
    const double whole =
        Utilities::MPI::sum(std::accumulate(own.begin(), own.end(), 0.), communicator);
    last_marked = marking == Marking::bulk
                      ? last_of_share(own, value, fraction * whole, communicator)
                      : last_of_share(own, count, fraction * triangulation.n_global_active_cells(),
                                      communicator);
  }
  if (marking == Marking::all)
    last_marked = 0;
  const double left_to_part = std::pow(4., -(degree + 1.));
  const double most_now = std::min(most_cells, 4. * triangulation.n_global_active_cells());
  clear_flags(triangulation);
  flag(triangulation, scene, squares, last_marked);
  prepare(triangulation);
  if (n_cells_to_come(triangulation) > most_cells) {
    if (marking == Marking::all) {
      clear_flags(triangulation);
      return false;
    }
    last_marked = flag_as_many_as_fit(triangulation, scene, squares, last_marked, most_cells);
  }
  if (count_flagged(triangulation) == 0)
    return false;
  execute(triangulation, squares, left_to_part);
  while (marking != Marking::all) {
    for (const auto& cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && cell->user_index() == 0 &&
          squares(cell->active_cell_index()) > last_marked)
        cell->set_refine_flag();
    flag_columns(triangulation, scene);
    prepare(triangulation);
    if (count_flagged(triangulation) == 0 || n_cells_to_come(triangulation) > most_now)
      break;
    execute(triangulation, squares, left_to_part);
  }
  clear_flags(triangulation);
  return true;
}

} // namespace

bool has_room_to_refine(const Triangulation<2>& triangulation, Marking marking, double most_cells) {
  const double least_growth = marking == Marking::all ? 4 : 1.2;
  return least_growth * triangulation.n_global_active_cells() <= most_cells;
}

bool refine_mesh(Triangulation<2>& triangulation, const Scene& scene,
                 const std::vector<double>& indicators, Marking marking, double fraction,
                 unsigned int degree, double most_cells) {
  const bool is_changed =
      refine_in_place(triangulation, scene, indicators, marking, fraction, degree, most_cells);
  if (auto* const distributed =
          dynamic_cast<parallel::distributed::Triangulation<2>*>(&triangulation);
      distributed && is_changed)
    distributed->repartition();
  return is_changed;
}

bool is_at_finest_level(const Triangulation<2>& triangulation) {
  return triangulation.n_global_levels() > finest_level;
}

} // namespace rollwave
