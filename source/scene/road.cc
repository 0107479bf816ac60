#include "rollwave/scene/road.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rollwave {

using namespace dealii;

double from_lowest_point(double z) {
  constexpr double rounded = 4.71238898038468985769, // the double nearest to 3 pi/2
      rest = 1.8369701987210297e-16;
  return (z - rounded) - rest;
}

double Road::root(double x) const {
  if (curvature == 0)
    return std::cos(x);
  const double t = (1 + curvature * distance) * std::sin(x);
  return (curvature < 0 || std::cos(x) > 0) && std::abs(t) < 1 ? std::sqrt((1 - t) * (1 + t)) : 0;
}

double Road::displacement(double x) const {
  const double c = distance, b = outer_radius, half = std::sin(x / 2), square = half * half;
  if (curvature == 0)
    return (c - b) + 2 * c * square / std::cos(x);
  const double m = 1 + curvature * c, s = root(x);
  if (s == 0)
    return std::max(b, std::sqrt(c * c + 2 * c / curvature) - b);
  const double sine = m * std::sin(x);
  return (c - b) + c * (2 * m * square + sine * sine / (1 + s)) / (m * std::cos(x) + s);
}

double Road::slope(double x) const {
  const double s = root(x);
  if (curvature == 0)
    return distance * std::sin(x) / (s * s);
  return s == 0 ? 0
                : (outer_radius + displacement(x)) * (1 + curvature * distance) * std::sin(x) / s;
}

double Road::distance_derivative(double x) const {
  const double s = root(x), sine = std::sin(x);
  if (curvature == 0)
    return 1 / s;
  return s == 0 ? 0 : std::cos(x) + (1 + curvature * distance) * sine * sine / s;
}

double Road::second_distance_derivative(double x) const {
  const double s = root(x);
  return s == 0 ? 0 : curvature * std::pow(std::sin(x), 2) / std::pow(s, 3);
}

double Road::crossing_angle(double free) const {
  // On the circle 1 - cos x = depth (2 - kappa depth) / (2 rho m), depth = rho - c.
  const double c = distance, m = 1 + curvature * c, rho = outer_radius + free;
  const double depth = (outer_radius - c) + free;
  if (depth <= 0)
    return 0;
  if (curvature > 0 && rho >= std::sqrt(c * c + 2 * c / curvature))
    return tangent_angle();
  const double square = depth * (2 - curvature * depth) / (4 * rho * m);
  return 2 * std::asin(std::sqrt(std::min(square, 1.)));
}

double Road::tangent_angle() const {
  return curvature > 0 ? std::asin(1 / (1 + curvature * distance)) : numbers::PI;
}

double Road::arc_length(double x) const {
  x = std::clamp(x, -tangent_angle(), tangent_angle());
  // Sine and cosine of the angle at the centre of the circle, the sine over kappa.
  const double c = distance, m = 1 + curvature * c, s = root(x);
  const double sine = c * (2 + curvature * c) * std::sin(x) / (m * std::cos(x) + s),
               cosine = s * std::cos(x) + m * std::sin(x) * std::sin(x);
  return curvature == 0 ? sine : std::atan2(curvature * sine, cosine) / curvature;
}

double Road::greatest_distance() const {
  return curvature < 0 ? -1 / curvature : std::numeric_limits<double>::infinity();
}

std::vector<std::pair<double, double>> Road::points(double longest) const {
  const double most = numbers::PI * (is_convex() ? 1 : 0.5), size = std::abs(curvature);
  const double half = size * longest > most ? most / size : longest;
  constexpr int n = 400;
  std::vector<std::pair<double, double>> points;
  for (int i = -n; i <= n; ++i) {
    const double s = half * i / n, sine = std::sin(curvature * s / 2);
    if (curvature == 0)
      points.emplace_back(s, -distance);
    else
      points.emplace_back(std::sin(curvature * s) / curvature,
                          -distance - 2 * sine * sine / curvature);
  }
  return points;
}

bool Road::is_visible(double x) const {
  return curvature < 0 || std::cos(x) > 0;
}

Obstacle make_obstacle(const Road& road) {
  return {[road](double z) { return road.displacement(from_lowest_point(z)); },
          [road](double z) { return road.slope(from_lowest_point(z)); }};
}

} // namespace rollwave
