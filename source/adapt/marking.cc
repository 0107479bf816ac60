#include "rollwave/adapt/marking.h"

#include "rollwave/base/mpi_processes.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/p4est_wrappers.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/fe/mapping_q_cache.h>
#include <deal.II/grid/grid_refinement.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/numerics/error_estimator.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace rollwave {

using namespace dealii;

unsigned int most_cycles(const RefinementOptions& options) {
  return options.adaptive_cycles.value_or(
      options.wanted_relative_error > 0 ? std::numeric_limits<unsigned int>::max() : 0);
}

bool is_adaptive(const RefinementOptions& options) {
  return most_cycles(options) > 0 && options.marking != Marking::all;
}

bool has_room_to_refine(const Triangulation<2>& triangulation, const RefinementOptions& options,
                        double most_cells) {
  const double least_growth = options.marking == Marking::all ? 4 : 1.2;
  return least_growth * triangulation.n_global_active_cells() <= most_cells;
}

std::vector<double> kelly_indicator(const RingSpace& space, const FieldVector& field) {
  const auto& triangulation = space.dof_handler().get_triangulation();
  // In (r, b z), where both directions are lengths.
  const double b = space.outer_radius();
  MappingQCache<2> mapping(1);
  mapping.initialize(
      space.mapping(), triangulation,
      [b](const auto&, const Point<2>& point) { return Point<2>(point[0], b * point[1]); },
      /*function_describes_relative_displacement=*/false);
  Vector<float> indicators(triangulation.n_active_cells());
  KellyErrorEstimator<2>::estimate(mapping, space.dof_handler(),
                                   QGauss<1>(space.dof_handler().get_fe().degree + 1), {}, field,
                                   indicators);
  std::vector<double> lengths(indicators.begin(), indicators.end());
  for (const auto& cell : triangulation.active_cell_iterators()) {
    // The estimator multiplies by the square root of the diameter in (r, z). This replaces it by
    // the diameter in (r, b z).
    const Tensor<1, 2> diagonal = cell->vertex(3) - cell->vertex(0);
    lengths[cell->active_cell_index()] *=
        std::sqrt(std::hypot(diagonal[0], b * diagonal[1]) / diagonal.norm());
  }
  return lengths;
}

namespace {

/// Cells with less than this part of the largest indicator are left out. Without this limit, meshes
/// of contact in a point grow fourfold where only its innermost cells need a cut.
constexpr double least_indicator = 0.25;

constexpr int finest_level = internal::p4est::functions<2>::max_level - 1;

using MeshCell = Triangulation<2>::active_cell_iterator;

/// The indicators over the largest one, 0 on cells of other processes.
Vector<double> scaled_indicators(const Triangulation<2>& triangulation,
                                 const std::vector<double>& indicators) {
  Vector<double> scaled(triangulation.n_active_cells());
  for (const auto& cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      scaled[cell->active_cell_index()] = indicators[cell->active_cell_index()];
  const double largest =
      Utilities::MPI::max(scaled.linfty_norm(), triangulation.get_communicator());
  if (largest > 0)
    scaled /= largest;
  return scaled;
}

/// The sum of all squares.
double squared_norm(const Vector<double>& indicators, MPI_Comm communicator) {
  return Utilities::MPI::sum(indicators.norm_sqr(), communicator);
}

/// Indicators of cells, and the fraction of the sum of their squares to mark.
struct Bulk {
  Vector<double> indicators;
  double fraction;
};

/// The indicators of the cells that count, 0 on others; and @p marked_fraction, or less if less
/// lets the error fall to the part @p goal of what it is. The cells with the largest errors lie
/// where the solution is least smooth: cutting them leaves about a quarter of their squared errors.
Bulk choose_bulk(const Triangulation<2>& triangulation, const std::vector<double>& indicators,
                 double goal, double marked_fraction) {
  const MPI_Comm communicator = triangulation.get_communicator();
  Vector<double> scaled = scaled_indicators(triangulation, indicators), at_finest(scaled.size());
  for (const auto& cell : triangulation.active_cell_iterators())
    if (cell->level() >= finest_level)
      std::swap(at_finest[cell->active_cell_index()], scaled[cell->active_cell_index()]);
  const double fixed = squared_norm(at_finest, communicator),
               reducible = squared_norm(scaled, communicator), all = fixed + reducible;
  // Where cuts of other cells cannot reach the goal, or gain little, these count as well, so that
  // refinement ends when the others have far less than these.
  if (fixed > (goal > 0 ? goal * goal * all : reducible))
    scaled += at_finest;
  constexpr double left = 0.25, margin = 0.95;
  const double to_remove = (1 - std::pow(margin * goal, 2)) * all;
  return {scaled, std::min(marked_fraction, to_remove / ((1 - left) * reducible))};
}

/// The indicator from which on cells are marked: the largest t for which the indicators from t on
/// hold @p fraction of the sum of all squares, but not less than least_indicator of the largest.
double marking_threshold(const Vector<double>& indicators, double fraction, MPI_Comm communicator) {
  const double largest = Utilities::MPI::max(indicators.linfty_norm(), communicator);
  const auto sum_from = [&](double t) {
    double sum = 0;
    for (const double indicator : indicators)
      if (indicator >= t)
        sum += indicator * indicator;
    return Utilities::MPI::sum(sum, communicator);
  };
  const double wanted = fraction * sum_from(0);
  double low = 0, high = largest;
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = (low + high) / 2;
    (sum_from(middle) >= wanted ? low : high) = middle;
  }
  // The indicators of mirror images differ by round-off, which must not choose between them.
  return (1 - 1e-6) * std::max(low, least_indicator * largest);
}

/// The thickness of the ring in the coordinate s = int alpha^(1/2) dr, in which sin(k z) decays
/// like exp(-k s).
double natural_depth(const Scene& scene) {
  const double a = scene.inner_radius, b = scene.outer_radius;
  const QGauss<1> gauss(20);
  double depth = 0;
  for (unsigned int q = 0; q < gauss.size(); ++q)
    depth += gauss.weight(q) * (b - a) *
             std::sqrt(std::max(0., scene.alpha(a + (b - a) * gauss.point(q)[0])));
  return depth;
}

/// Flags the cells of the same level above and below each flagged cell that is longer than the
/// natural depth of the ring. There the solution has the same angular length scale from hub to
/// surface. If only a part of the column were cut, hanging nodes would lie within that depth and
/// cause further refinement.
void flag_columns(Triangulation<2>& triangulation, double depth) {
  for (const auto& cell : triangulation.active_cell_iterators()) {
    if (cell->is_artificial() || !cell->refine_flag_set() ||
        cell->vertex(3)[1] - cell->vertex(0)[1] <= depth)
      continue;
    for (const unsigned int face : {0U, 1U})
      for (Triangulation<2>::cell_iterator last = cell; !last->at_boundary(face);) {
        last = last->neighbor(face);
        if (!last->is_active() || last->level() != cell->level() || !last->is_locally_owned() ||
            last->refine_flag_set())
          break;
        last->set_refine_flag();
      }
  }
}

/// Flags the cells next to those of a process that are flagged on their own process.
void share_flags(Triangulation<2>& triangulation) {
  if (is_serial(triangulation.get_communicator()))
    return;
  GridTools::exchange_cell_data_to_ghosts<int, Triangulation<2>>(
      triangulation,
      [](const MeshCell& cell) -> std::optional<int> { return cell->refine_flag_set(); },
      [](const MeshCell& cell, int is_flagged) {
        if (is_flagged)
          cell->set_refine_flag();
      });
}

/// Flags further cells where cutting the flagged ones makes it necessary.
/// @return the number of flagged cells of all processes
double complete_flags(Triangulation<2>& triangulation, double depth) {
  for (double count = -1;;) { // until no process has more to pass on
    share_flags(triangulation);
    flag_columns(triangulation, depth);
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

void clear_flags(Triangulation<2>& triangulation) {
  for (const auto& cell : triangulation.active_cell_iterators())
    cell->clear_refine_flag();
}

} // namespace

bool refine_mesh(Triangulation<2>& triangulation, const Scene& scene,
                 const std::vector<double>& indicators, double goal,
                 const RefinementOptions& options, double most_cells) {
  const MPI_Comm communicator = triangulation.get_communicator();
  const Bulk bulk = choose_bulk(triangulation, indicators, goal, options.marked_fraction);
  const double depth = natural_depth(scene);
  const auto flag = [&](double share) {
    clear_flags(triangulation);
    if (options.marking == Marking::all)
      triangulation.set_all_refine_flags();
    else
      GridRefinement::refine(triangulation, bulk.indicators,
                             marking_threshold(bulk.indicators, share, communicator));
    for (const auto& cell : triangulation.active_cell_iterators())
      if (cell->level() >= finest_level)
        cell->clear_refine_flag();
    return complete_flags(triangulation, depth);
  };
  const double most_flagged = (most_cells - triangulation.n_global_active_cells()) / 3;
  double n_flagged = flag(bulk.fraction);
  if (n_flagged > most_flagged && has_room_to_refine(triangulation, options, most_cells)) {
    double fits = 0, is_too_large = bulk.fraction;
    for (int halving = 0; halving < 10; ++halving) {
      const double middle = (fits + is_too_large) / 2;
      (flag(middle) <= most_flagged ? fits : is_too_large) = middle;
    }
    n_flagged = flag(fits);
  }
  if (n_flagged == 0 || n_flagged > most_flagged) {
    clear_flags(triangulation);
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
