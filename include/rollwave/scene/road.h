#pragma once

#include <deal.II/base/numbers.h>

#include <functional>
#include <utility>
#include <vector>

namespace rollwave {

/// The angle z of the lowest point.
constexpr double lowest_point = 1.5 * dealii::numbers::PI;

/// x = z - 3 pi/2, the angle from the lowest point, to the accuracy of z: 3 pi/2 is taken in two
/// parts.
double from_lowest_point(double z);

/**
 * A rigid road of the curvature kappa (0: flat, positive: the outside of a drum, negative: the
 * inside of one) whose nearest point lies at the distance c below the axle. It lies at the radius
 *
 *     rho(x) = (2 c + kappa c^2) / (m cos x + R),   m = 1 + kappa c,   R = (1 - m^2 sin^2 x)^(1/2),
 *
 * which is c / cos x for kappa = 0. A drum ends at its tangent from the axle, m sin x = 1; beyond,
 * phi is b or more.
 */
struct Road {
  double outer_radius;  ///< b, a length
  double distance;      ///< c, a length
  double curvature = 0; ///< kappa, one over a length

  /// phi = rho - b, a length. Near the lowest point nothing cancels.
  double displacement(double x) const;

  /// dphi/dx = rho m sin x / R
  double slope(double x) const;

  /// dphi/dc = cos x + m sin^2 x / R, which is 1 / cos x on a flat road
  double distance_derivative(double x) const;

  /// d^2 phi/dc^2 = kappa sin^2 x / R^3, which is 0 on a flat road
  double second_distance_derivative(double x) const;

  /// The angle at which the road meets a surface of the radius b + @p free: the angle of the
  /// tangent if the road does not reach that radius, 0 if the surface lies above the road.
  double crossing_angle(double free) const;

  /// The angle of the tangent of a drum, asin(1 / m); pi for roads without a tangent.
  double tangent_angle() const;

  /// True for the outside of a drum, the only road with a tangent.
  bool is_convex() const { return curvature > 0; }

  /// The largest distance: -1/kappa inside of a drum, where its axis is the axle's, else infinity.
  double greatest_distance() const;

  /// True if a ray from the axle at the angle @p x can meet the road: all of them inside of a drum,
  /// otherwise those that point downwards.
  bool is_visible(double x) const;

  /// The same road at the distance @p c.
  Road at(double c) const { return {outer_radius, c, curvature}; }

  /// The length of the road between its lowest point and the angle x, up to the tangent:
  /// (asin(m sin x) - x) / kappa, the arc of the circle, which is c tan x for kappa = 0.
  double arc_length(double x) const;

  /// Points (x, y) of the road, equally spaced by their distance s along it from the lowest point:
  /// x = sin(kappa s) / kappa, y = -c - (1 - cos(kappa s)) / kappa, |s| <= @p longest; once around
  /// a drum at most, the lower half inside of one.
  std::vector<std::pair<double, double>> points(double longest) const;

private:
  double root(double x) const; ///< R, 0 beyond the tangent
};

/// phi(z), the displacement at which the surface touches the road, and its slope dphi/dz.
struct Obstacle {
  std::function<double(double z)> displacement;
  std::function<double(double z)> slope;

  double operator()(double z) const { return displacement(z); }
};

/// The obstacle of a road.
Obstacle make_obstacle(const Road& road);

} // namespace rollwave
