#include "force_panel_choice.h"

#include "load_points.h"
#include "scene.h"
#include "straight_jump.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <unordered_set>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

constexpr double round_off_of_force = 1e-13; ///< of f_0
constexpr double smallest = 4e-15;           ///< panel, over its distance from the origin

/// Sizes and places of cells are often those of panels, and round-off shall not decide.
constexpr double slight = 1e-9; ///< over sizes of panels

class Chooser {
public:
  Chooser(const RingSpace& space, const Scene& scene, const std::vector<double>& moments,
          const RadialExtents& extents)
      : panels(scene), space(space), scene(scene), load_points(space, moments, extents) {
    find_cells();
    halve_where_fine();
    for (unsigned int i = 0; i < panels.size(); ++i)
      if (panels.is_part(i))
        add(i);
    const double norm = panels.friedrichs_norm(scene);
    usual.mean = norm / std::sqrt(friedrichs_squared(scene) * panels[0].area());
    most_panels = panels.size() + 16 + space.n_unknowns() / 100;
    negligible_squared = std::pow(negligible_error_of_force(space, scene, panels), 2) / most_panels;
    allowed_squared =
        std::max(std::pow(round_off_of_force * norm, 2) / most_panels, 1e-10 * negligible_squared);
    do
      halve_the_worst(panels.size() + 3 * (most_panels - panels.size()) / 4);
    while (quarter_where_load_points_see_more());
    halve_the_worst(most_panels);
    if (panels.size() > n_looked_at)
      look_at_load_points();
  }

  ForcePanels panels;

private:
  /// Numbers of panels, the one with the largest error first.
  using Queue = std::priority_queue<std::pair<double, unsigned int>>;

  std::optional<double> find_jump(unsigned int i, unsigned int direction) const {
    return straight_jump(scene, panels[i].low, panels[i].high, direction);
  }

  /// Cuts a part at a straight jump, else in the middle, and @returns the number of the inner one.
  unsigned int cut(unsigned int i, unsigned int direction) {
    const auto jump = find_jump(i, direction);
    return jump ? panels.cut(scene, i, direction, *jump) : panels.halve(scene, i, direction);
  }

  /// Cuts the panels that have more than their share of the cells.
  void halve_where_fine();

  /// @param most panels in the end
  void halve_the_worst(unsigned int most);

  /// @returns whether there were such panels.
  bool quarter_where_load_points_see_more();

  /// Panels miss what the points of the load say, if that is more. Only those not looked at before.
  /// @returns those on which these see what its own points do not, with the square of the bound.
  Queue look_at_load_points();

  bool is_divisible(const ForcePanel& panel, unsigned int direction) const {
    return panel.high[direction] - panel.low[direction] >= smallest * panel.high[direction];
  }

  /// A part, to be judged.
  void add(unsigned int i);

  void find_cells();

  /// The coordinates of the centers of all cells, in order.
  const std::vector<double>& cell_centers(unsigned int direction);

  const RingSpace& space;
  const Scene& scene;
  LoadPoints load_points;
  Queue worst;
  unsigned int most_panels = 0, n_looked_at = 0;
  double negligible_squared = 0, allowed_squared = 0;
  /// A force of the usual size that is not seen at all.
  ForcePanel::Missed usual = {std::numeric_limits<double>::infinity(), 0, 0};
  std::vector<Point<2>> own_centers; ///< of this process' cells, with angles in [0, 2 pi)
  Tensor<1, 2> largest_cell;         ///< in each direction
  std::vector<double> coordinates[2];
};

void Chooser::find_cells() {
  for (const auto& cell : space.dof_handler().get_triangulation().active_cell_iterators())
    if (cell->is_locally_owned()) {
      const Tensor<1, 2> size = cell->vertex(3) - cell->vertex(0);
      const Point<2> center = cell->vertex(0) + size / 2;
      const double period = center[1] < 2 * numbers::PI ? 0 : 2 * numbers::PI;
      own_centers.emplace_back(center[0], center[1] - period);
      for (const unsigned int direction : {0, 1})
        largest_cell[direction] = std::max(largest_cell[direction], size[direction]);
    }
  for (const unsigned int direction : {0, 1})
    largest_cell[direction] = Utilities::MPI::max(largest_cell[direction], space.communicator());
}

const std::vector<double>& Chooser::cell_centers(unsigned int direction) {
  std::vector<double>& all = coordinates[direction];
  if (all.empty()) {
    std::unordered_set<double> own;
    for (const Point<2>& center : own_centers)
      own.insert(center[direction]);
    for (const auto& some : Utilities::MPI::all_gather(space.communicator(),
                                                       std::vector<double>(own.begin(), own.end())))
      all.insert(all.end(), some.begin(), some.end());
    std::sort(all.begin(), all.end());
    const double least = slight * (all.back() - all.front());
    const auto are_same = [least](double x, double y) { return y - x <= least; };
    all.erase(std::unique(all.begin(), all.end(), are_same), all.end());
  }
  return all;
}

void Chooser::add(unsigned int i) {
  ForcePanel& panel = panels[i];
  panel.judge(scene);
  const Tensor<1, 2> size = panel.high - panel.low;
  for (const unsigned int direction : {0, 1})
    if (size[1 - direction] < (1 - slight) * 2 * largest_cell[1 - direction] &&
        panel.squared_alone(scene, usual) > negligible_squared) {
      const auto& centers = cell_centers(direction);
      const double roundings = 1e-14 * panel.high[direction];
      const auto begin =
          std::upper_bound(centers.begin(), centers.end(), panel.low[direction] + roundings);
      const auto end = std::lower_bound(begin, centers.end(), panel.high[direction] - roundings);
      if (end - begin > ForcePanel::n_points)
        panel.look_along(scene, direction, {begin, end});
    }
  worst.push({panel.squared_alone(scene, panel.missed), i});
}

void Chooser::halve_where_fine() {
  const auto& triangulation = space.dof_handler().get_triangulation();
  const unsigned int n_cells = triangulation.n_global_active_cells();
  const double most_cells = n_cells * std::max(1. / 32, 128. / space.n_unknowns());
  struct Cells {
    std::vector<Point<2>>::iterator begin, end; ///< of the own centers on a panel
    unsigned int n_all;                         ///< on all processes
  };
  std::vector<Cells> cells = {{own_centers.begin(), own_centers.end(), n_cells}};
  for (unsigned int i = 0; i < panels.size(); ++i) {
    const Cells whole = cells[i];
    if (whole.n_all <= most_cells)
      continue;
    unsigned int direction = panels[i].rougher_direction();
    const Tensor<1, 2> size = panels[i].high - panels[i].low, all = panels[0].high - panels[0].low;
    if (16 * size[direction] / all[direction] < size[1 - direction] / all[1 - direction])
      direction = 1 - direction; // does not reach single cells along a jump
    // f_0 may not see a jump, and each part would have to be cut there.
    if (!find_jump(i, direction) && find_jump(i, 1 - direction))
      direction = 1 - direction;
    const double middle = panels[cut(i, direction)].high[direction];
    const auto outer = std::partition(whole.begin, whole.end, [&](const Point<2>& center) {
      return center[direction] < middle + slight * size[direction];
    });
    const unsigned int n_inner =
        Utilities::MPI::sum<unsigned int>(outer - whole.begin, triangulation.get_communicator());
    cells.push_back({whole.begin, outer, n_inner});
    cells.push_back({outer, whole.end, whole.n_all - n_inner});
  }
}

void Chooser::halve_the_worst(unsigned int most) {
  while (!worst.empty() && panels.size() < most) {
    const auto [error_squared, i] = worst.top();
    worst.pop();
    const bool is_resolved = panels[i].is_resolved();
    if (is_resolved && error_squared <= allowed_squared)
      continue;
    if (panels[i].squared_alone(scene, panels[i].beside_mean) <= negligible_squared) {
      if (!is_resolved)
        panels[i].flatten();
      continue;
    }
    const unsigned int direction = panels[i].rougher_direction();
    if (!is_divisible(panels[i], direction))
      continue; // a jump between neighbouring numbers
    const unsigned int inner = cut(i, direction);
    add(inner);
    add(inner + 1);
  }
}

Chooser::Queue Chooser::look_at_load_points() {
  const unsigned int first = std::exchange(n_looked_at, panels.size());
  const auto at_load_points = load_points.missed(panels, first);
  Queue seen_badly;
  for (unsigned int i = first; i < panels.size(); ++i) {
    const auto& [n_points, mean, mean_square] = at_load_points[i - first];
    ForcePanel& panel = panels[i];
    if (n_points == 0 || mean_square <= 4 * panel.mean_square())
      continue;
    panel.take_for(scene, mean, mean_square);
    const double error_squared = panel.squared_alone(scene, panel.missed);
    if (error_squared > negligible_squared && is_divisible(panel, 0) && is_divisible(panel, 1))
      seen_badly.push({error_squared, i});
  }
  return seen_badly;
}

bool Chooser::quarter_where_load_points_see_more() {
  const unsigned int n_before = panels.size();
  for (Queue seen_badly = look_at_load_points(); !seen_badly.empty(); seen_badly.pop()) {
    if (panels.size() + 6 > most_panels)
      break;
    const unsigned int first_half = panels.halve(scene, seen_badly.top().second, 0);
    for (const unsigned int half : {first_half, first_half + 1}) {
      const unsigned int first_quarter = panels.halve(scene, half, 1);
      add(first_quarter);
      add(first_quarter + 1);
    }
  }
  return panels.size() > n_before;
}

} // namespace

double negligible_error_of_force(const RingSpace& space, const Scene& scene,
                                 const ForcePanels& panels) {
  const unsigned int degree = space.dof_handler().get_fe().degree;
  return 0.01 * std::pow(space.n_unknowns(), -0.5 * degree) * panels.friedrichs_norm(scene);
}

ForcePanels choose_force_panels(const RingSpace& space, const Scene& scene,
                                const std::vector<double>& moments, const RadialExtents& extents) {
  return std::move(Chooser(space, scene, moments, extents).panels);
}

} // namespace rollwave
