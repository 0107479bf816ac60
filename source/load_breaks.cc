#include "load_breaks.h"

#include "processes.h"
#include "scene.h"
#include "straight_jump.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rollwave {

using namespace dealii;

namespace {

constexpr double full_turn = 2 * numbers::PI;

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

std::vector<double> cut_interval(double begin, double end, const std::vector<double>& places,
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
  return cut_interval(begin, end, radii, std::numeric_limits<double>::infinity());
}

std::vector<double> LoadBreaks::angular_ends(double begin, double end) const {
  return cut_interval(begin, end, angles, full_turn);
}

LoadBreaks find_load_breaks(const Scene& scene, unsigned int n_cells, MPI_Comm communicator) {
  constexpr unsigned int cells_along = 12;
  const double height = scene.outer_radius - scene.inner_radius,
               circumference = full_turn * scene.outer_radius;
  const double size = cells_along * std::sqrt(height * circumference / n_cells);
  // Of a thin ring no more in a direction than there are cells.
  const auto count = [&](double length) {
    return std::ceil(std::min(length / size, 1. * n_cells / cells_along));
  };
  const unsigned int n_radial = count(height), n_angular = count(circumference);
  const Point<2> step(height / n_radial, full_turn / n_angular);
  const Tensor<1, 2> overlap = step / cells_along;
  LoadBreaks breaks;
  for (unsigned int i = process_number(communicator); i < n_radial * n_angular;
       i += count_processes(communicator)) {
    const Point<2> low(scene.inner_radius + i % n_radial * step[0], i / n_radial * step[1]);
    const Point<2> high(std::min(low[0] + step[0], scene.outer_radius),
                        std::min(low[1] + step[1], full_turn));
    // Overlapping, since jumps on an edge are seen on neither side of it.
    const double inner = std::max(low[0] - overlap[0], scene.inner_radius),
                 outer = std::min(high[0] + overlap[0], scene.outer_radius),
                 begin = std::max(low[1] - overlap[1], 0.),
                 end = std::min(high[1] + overlap[1], full_turn);
    add_jumps(scene, {inner, low[1]}, {outer, high[1]}, 0, overlap[0], breaks.radii);
    add_jumps(scene, {low[0], begin}, {high[0], end}, 1, overlap[1], breaks.angles);
    if (low[1] == 0) {
      Scene periodic = scene;
      periodic.force = [&scene](double r, double z) {
        return scene.force(r, z < full_turn ? z : z - full_turn);
      };
      // So narrow that other jumps beside the period do not hide its own.
      const double beside = overlap[1] / 1000;
      add_jumps(periodic, {low[0], full_turn - beside}, {high[0], full_turn + beside}, 1,
                overlap[1], breaks.angles);
    }
  }
  for (double& angle : breaks.angles)
    angle = angle < full_turn ? angle : angle - full_turn;
  return {of_all(std::move(breaks.radii), communicator),
          of_all(std::move(breaks.angles), communicator)};
}

} // namespace rollwave
