#pragma once

#include <functional>
#include <optional>

namespace rollwave {

/// The radial force density f(r, z) of a scene, positive outwards.
struct BodyForce {
  /// f, a pressure over a length, where it is a constant, so that its integrals need no quadrature.
  std::optional<double> uniform = {};

  /// f where it is an expression, for z in [0, 2 pi).
  std::function<double(double r, double z)> density = {};

  /// True if there is a force.
  explicit operator bool() const { return uniform || density; }

  bool is_expression() const { return density != nullptr; }

  double operator()(double r, double z) const { return uniform ? *uniform : density(r, z); }
};

} // namespace rollwave
