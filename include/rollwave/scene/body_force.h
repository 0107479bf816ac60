#pragma once

#include <functional>
#include <optional>

namespace rollwave {

/// The radial force density f(r, z) of a scene, positive outwards.
struct BodyForce {
  /// f, a pressure over a length, for z in [0, 2 pi); empty without a force.
  std::function<double(double r, double z)> density = {};

  /// f where it is a constant that is known, so that its integrals need no quadrature.
  std::optional<double> uniform = {};

  /// True if there is a force.
  explicit operator bool() const { return density != nullptr; }

  bool is_expression() const { return density && !uniform; }

  double operator()(double r, double z) const { return density(r, z); }
};

} // namespace rollwave
