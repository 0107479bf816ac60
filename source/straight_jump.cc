#include "straight_jump.h"

#include "scene.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rollwave {

using namespace dealii;

namespace {

/// f at a place on lines along a direction.
using OnLines = std::array<double, 3>;

OnLines force_on_lines(const Scene& scene, const ForcePanel& panel, unsigned int direction,
                       double place) {
  OnLines values;
  for (unsigned int line = 0; line < values.size(); ++line) {
    const unsigned int across = 1 - direction;
    Point<2> point;
    point[direction] = place;
    point[across] =
        panel.low[across] + (0.1 + 0.4 * line) * (panel.high[across] - panel.low[across]);
    values[line] = scene.force(point[0], point[1]);
  }
  return values;
}

/// How f changes between two places.
struct Change {
  Change(const OnLines& before, const OnLines& beyond) {
    OnLines all;
    for (unsigned int line = 0; line < all.size(); ++line)
      all[line] = std::abs(beyond[line] - before[line]);
    const double largest = *std::max_element(all.begin(), all.end());
    for (const double change : all) {
      sum += change;
      n_lines += change > largest / 10;
    }
  }

  double sum = 0;
  unsigned int n_lines = 0; ///< that see it
};

} // namespace

std::optional<double> straight_jump(const Scene& scene, const ForcePanel& panel,
                                    unsigned int direction) {
  const auto on_lines = [&](double x) { return force_on_lines(scene, panel, direction, x); };
  constexpr unsigned int n_parts = ForcePanel::n_points;
  const auto place = [&](unsigned int part) {
    return panel_point(panel.low[direction], panel.high[direction], 1. * part / n_parts);
  };
  double low = place(0), high = low;
  OnLines before = on_lines(low), beyond = before, last = before;
  Change change(before, beyond); // from low to high
  for (unsigned int part = 1; part <= n_parts; ++part) {
    const OnLines values = on_lines(place(part));
    if (const Change here(last, values); here.sum > change.sum) {
      change = here;
      before = last;
      beyond = values;
      low = place(part - 1);
      high = place(part);
    }
    last = values;
  }
  // Of what is smooth a half changes half as much.
  const double whole = change.sum;
  while (change.sum > whole / 2 && change.n_lines > 1) {
    const double middle = (low + high) / 2;
    if (middle <= low || middle >= high)
      return high;
    const OnLines values = on_lines(middle);
    const Change below(before, values), above(values, beyond);
    const bool is_below = below.sum > above.sum;
    change = is_below ? below : above;
    (is_below ? high : low) = middle;
    (is_below ? beyond : before) = values;
  }
  return std::nullopt;
}

bool jumps_between(const Scene& scene, const ForcePanel& panel, unsigned int direction,
                   double before, double beyond) {
  const Change change(force_on_lines(scene, panel, direction, before),
                      force_on_lines(scene, panel, direction, beyond));
  // More than f changes on the way, beside its size on the panel.
  constexpr double slight = 1e-6;
  return change.n_lines > 1 &&
         change.sum > slight * panel.coefficients.frobenius_norm() / panel.low[0];
}

} // namespace rollwave
