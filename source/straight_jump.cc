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

OnLines force_on_lines(const Scene& scene, const Point<2>& low, const Point<2>& high,
                       unsigned int direction, double place) {
  OnLines values;
  for (unsigned int line = 0; line < values.size(); ++line) {
    const unsigned int across = 1 - direction;
    Point<2> point;
    point[direction] = place;
    point[across] = low[across] + (0.1 + 0.4 * line) * (high[across] - low[across]);
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

double point_within(double begin, double end, double share) {
  const double roundings =
      std::min(2e-15 * std::max(std::abs(begin), std::abs(end)), (end - begin) / 4);
  return std::clamp(begin + share * (end - begin), begin + roundings, end - roundings);
}

std::optional<double> straight_jump(const Scene& scene, const Point<2>& low, const Point<2>& high,
                                    unsigned int direction) {
  const auto on_lines = [&](double x) { return force_on_lines(scene, low, high, direction, x); };
  constexpr unsigned int n_parts = 12;
  const auto place = [&](unsigned int part) {
    return point_within(low[direction], high[direction], 1. * part / n_parts);
  };
  double begin = place(0), end = begin;
  OnLines before = on_lines(begin), beyond = before, last = before;
  Change change(before, beyond); // from begin to end
  for (unsigned int part = 1; part <= n_parts; ++part) {
    const OnLines values = on_lines(place(part));
    if (const Change here(last, values); here.sum > change.sum) {
      change = here;
      before = last;
      beyond = values;
      begin = place(part - 1);
      end = place(part);
    }
    last = values;
  }
  // Of what is smooth a half changes half as much.
  const double whole = change.sum;
  while (change.sum > whole / 2 && change.n_lines > 1) {
    const double middle = (begin + end) / 2;
    if (middle <= begin || middle >= end)
      return end;
    const OnLines values = on_lines(middle);
    const Change below(before, values), above(values, beyond);
    const bool is_below = below.sum > above.sum;
    change = is_below ? below : above;
    (is_below ? end : begin) = middle;
    (is_below ? beyond : before) = values;
  }
  return std::nullopt;
}

bool jumps_between(const Scene& scene, const Point<2>& low, const Point<2>& high,
                   unsigned int direction, double before, double beyond, double size) {
  const Change change(force_on_lines(scene, low, high, direction, before),
                      force_on_lines(scene, low, high, direction, beyond));
  // More than f changes on the way
  return change.n_lines > 1 && change.sum > 1e-6 * size;
}

} // namespace rollwave
