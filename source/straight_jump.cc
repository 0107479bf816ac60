#include "straight_jump.h"

#include "scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace rollwave {

using namespace dealii;

namespace {

/// f at a place on lines along a direction.
using OnLines = std::array<double, 5>;

/// Where the lines are, as shares of the rectangle: skins of a ring are as common as parts of it.
constexpr OnLines shares = {{0.04, 0.1, 0.5, 0.9, 0.96}};

OnLines force_on_lines(const Scene& scene, const Point<2>& low, const Point<2>& high,
                       unsigned int direction, double place) {
  OnLines values;
  for (unsigned int line = 0; line < values.size(); ++line) {
    const unsigned int across = 1 - direction;
    Point<2> point;
    point[direction] = place;
    point[across] = low[across] + shares[line] * (high[across] - low[across]);
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
  std::vector<OnLines> values;
  std::vector<Change> changes;
  for (unsigned int part = 0; part <= n_parts; ++part) {
    values.push_back(on_lines(place(part)));
    if (part > 0)
      changes.emplace_back(values[part - 1], values[part]);
  }
  // Of many alike the one nearest to the middle, lest panels be cut slice by slice.
  unsigned int chosen =
      std::max_element(changes.begin(), changes.end(),
                       [](const Change& x, const Change& y) { return x.sum < y.sum; }) -
      changes.begin();
  const double great = 0.9 * changes[chosen].sum;
  const auto from_middle = [](int part) { return std::abs(2 * part + 1 - int(n_parts)); };
  for (unsigned int part = 0; part < n_parts; ++part)
    if (changes[part].sum >= great && from_middle(part) < from_middle(chosen))
      chosen = part;
  double begin = place(chosen), end = place(chosen + 1);
  OnLines before = values[chosen], beyond = values[chosen + 1];
  Change change = changes[chosen]; // from begin to end
  // Of what is smooth a quarter changes a quarter as much. Half may be left of a jump: of two, and
  // where f itself is the mean of both sides. What changes by round-off only does not jump.
  double least = 0.4 * change.sum;
  for (const double value : before)
    least = std::max(least, 1e-13 * std::abs(value));
  while (change.sum > least && change.n_lines > 1) {
    const double middle = (begin + end) / 2;
    if (middle <= begin || middle >= end)
      return end;
    const OnLines between = on_lines(middle);
    const Change below(before, between), above(between, beyond);
    const bool is_below = below.sum > above.sum;
    change = is_below ? below : above;
    (is_below ? end : begin) = middle;
    (is_below ? beyond : before) = between;
  }
  return std::nullopt;
}

bool jumps_between(const Scene& scene, const Point<2>& low, const Point<2>& high,
                   unsigned int direction, double before, double beyond, double size) {
  const Change change(force_on_lines(scene, low, high, direction, before),
                      force_on_lines(scene, low, high, direction, beyond));
  // More than f changes on the way
  return change.sum > 1e-6 * size;
}

} // namespace rollwave
