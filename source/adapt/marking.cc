#include "rollwave/adapt/marking.h"

#include "rollwave/adapt/refinement_flags.h"
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

/// Flags the cells from the value @p last_marked on. Mirror images have the same indicator but for
/// round-off, which shall not choose between them.
void flag(Triangulation<2>& triangulation, const Scene& scene, const Vector<double>& squares,
          double last_marked) {
  for (const auto& cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && squares(cell->active_cell_index()) >= (1 - 1e-6) * last_marked)
      cell->set_refine_flag();
  flag_columns(triangulation, scene);
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
    settle_flags(triangulation);
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
  settle_flags(triangulation);
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
    settle_flags(triangulation);
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

} // namespace rollwave
