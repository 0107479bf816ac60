#include "load_breaks.h"

#include "processes.h"
#include "scene.h"
#include "straight_jump.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

namespace {

/// Adds the places on a rectangle, the greatest jump first, and on both sides of it, as far as
/// these are not shorter than @p least.
void add_jumps(const Scene& scene, const Point<2>& low, const Point<2>& high,
               unsigned int direction, double least, std::vector<double>& places) {
  const auto place = straight_jump(scene, low, high, direction);
  if (!place)
    return;
  places.push_back(*place);
  Point<2> inner = high, outer = low;
  inner[direction] = outer[direction] = *place;
  if (inner[direction] - low[direction] > least)
    add_jumps(scene, low, inner, direction, least, places);
  if (high[direction] - outer[direction] > least)
    add_jumps(scene, outer, high, direction, least, places);
}

std::vector<double> of_all(std::vector<double> places, MPI_Comm communicator) {
  std::vector<double> all;
  for (const auto& some : Utilities::MPI::all_gather(communicator, places))
    all.insert(all.end(), some.begin(), some.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

} // namespace

LoadBreaks find_load_breaks(const Scene& scene, unsigned int n_cells, MPI_Comm communicator) {
  constexpr double cells_along = 12, period = 2 * numbers::PI;
  const double height = scene.outer_radius - scene.inner_radius,
               circumference = period * scene.outer_radius;
  const double size = cells_along * std::sqrt(height * circumference / n_cells);
  const unsigned int n_radial = std::ceil(height / size),
                     n_angular = std::ceil(circumference / size);
  const Point<2> step(height / n_radial, period / n_angular);
  LoadBreaks breaks;
  for (unsigned int i = process_number(communicator); i < n_radial * n_angular;
       i += count_processes(communicator)) {
    const Point<2> begin(scene.inner_radius + i % n_radial * step[0], i / n_radial * step[1]);
    for (const unsigned int direction : {0, 1}) {
      // Overlapping, since jumps on an edge are seen on neither side of it.
      Point<2> low = begin, high = begin + step;
      const double overlap = step[direction] / cells_along;
      low[direction] = std::max(low[direction] - overlap, direction == 0 ? scene.inner_radius : 0);
      high[direction] =
          std::min(high[direction] + overlap, direction == 0 ? scene.outer_radius : period);
      add_jumps(scene, low, high, direction, overlap,
                direction == 0 ? breaks.radii : breaks.angles);
    }
  }
  breaks.angles.push_back(0);
  return {of_all(std::move(breaks.radii), communicator),
          of_all(std::move(breaks.angles), communicator)};
}

} // namespace rollwave
