#include "load_breaks.h"

#include "processes.h"
#include "scene.h"
#include "straight_jump.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rollwave {

using namespace dealii;

namespace {

constexpr double period = 2 * numbers::PI;

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

std::vector<double> ends_of_parts(double begin, double end, const std::vector<double>& places,
                                  double period) {
  std::vector<double> ends = {begin};
  for (double turn = 0; turn < end; turn += period)
    for (auto place = std::upper_bound(places.begin(), places.end(), begin - turn);
         place != places.end() && turn + *place < end; ++place)
      if (turn + *place > begin)
        ends.push_back(turn + *place);
  ends.push_back(end);
  return ends;
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

std::vector<double> LoadBreaks::radial_ends(double begin, double end) const {
  return ends_of_parts(begin, end, radii, std::numeric_limits<double>::infinity());
}

std::vector<double> LoadBreaks::angular_ends(double begin, double end) const {
  return ends_of_parts(begin, end, angles, period);
}

LoadBreaks find_load_breaks(const Scene& scene, unsigned int n_cells, MPI_Comm communicator) {
  constexpr double cells_along = 12;
  const double height = scene.outer_radius - scene.inner_radius,
               circumference = period * scene.outer_radius;
  const double size = cells_along * std::sqrt(height * circumference / n_cells);
  const unsigned int n_radial = std::ceil(height / size),
                     n_angular = std::ceil(circumference / size);
  const Point<2> step(height / n_radial, period / n_angular);
  Scene periodic = scene;
  periodic.force = [&scene](double r, double z) {
    return scene.force(r, z < period ? z : z - period);
  };
  LoadBreaks breaks;
  for (unsigned int i = process_number(communicator); i < n_radial * n_angular;
       i += count_processes(communicator)) {
    const Point<2> begin(scene.inner_radius + i % n_radial * step[0], i / n_radial * step[1]);
    for (const unsigned int direction : {0, 1}) {
      // Overlapping, since jumps on an edge are seen on neither side of it.
      Point<2> low = begin, high = begin + step;
      const double overlap = step[direction] / cells_along;
      low[direction] = std::max(low[direction] - overlap, direction == 0 ? scene.inner_radius : 0);
      high[direction] += overlap;
      if (direction == 0)
        high[0] = std::min(high[0], scene.outer_radius);
      add_jumps(periodic, low, high, direction, overlap,
                direction == 0 ? breaks.radii : breaks.angles);
    }
  }
  for (double& angle : breaks.angles)
    angle = angle < period ? angle : angle - period;
  return {of_all(std::move(breaks.radii), communicator),
          of_all(std::move(breaks.angles), communicator)};
}

} // namespace rollwave
