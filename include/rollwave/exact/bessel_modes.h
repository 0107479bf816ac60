#pragma once

#include <vector>

namespace rollwave {

/**
 * The modes R_k(r) cos(k z) of the homogeneous equation that vanish on the hub:
 *
 *     R'' + R'/r + k^2 (omega^2 - 1/r^2) R = 0,    R(a) = 0,
 *     R_k(r) ~ J_k(k omega r) Y_k(k omega a) - J_k(k omega a) Y_k(k omega r).
 *
 * Bessel functions of high order leave the range of double, their ratios do not. With g = J_k(k
 * omega r) and y = ln r, theta = dg/dy / g is a continued fraction; the second solution is g int dy
 * / g^2, so that with everything normalised at r = b
 *
 *     g(y) = exp(-int_y^(ln b) theta),   q(y) = int_(ln a)^y dy / g^2,
 *     R_k(r) / R_k(b) = g q(y) / q(ln b),
 *     sigma_k = R_k'(b) / R_k(b) = (theta(b) + 1/q(ln b)) / b.
 *
 * Integrals over y are taken by spectral integration on Gauss-Legendre points. Far inside, where
 * omega r is small, R_k ~ (r/a)^k - (a/r)^k.
 */
class BesselMode {
public:
  /// The mode of a real k >= 0.
  BesselMode(double inner_radius, double outer_radius, double angular_velocity, double k);

  /// 1 / sigma_k, a length: the surface displacement under a pressure of this mode.
  double compliance() const;

  /// R_k(r)/R_k(b) and R_k'(r)/R_k(b).
  struct ValueAndSlope {
    double value;
    double slope;
  };
  ValueAndSlope at(double r) const;

private:
  /// The length in y of the interval below the surface that has points.
  double interval() const;

  double a, b, omega, k;
  std::vector<double> exponent; ///< int_y^(ln b) theta at the points
  double theta_at_surface;
  double q; ///< int_(ln a)^(ln b) dy / g^2; infinite where the hub is too far inside to be felt
  std::vector<double> q_to_the_right; ///< int_y^(ln b) dy / g^2 at the points; empty without hub
};

/// The compliances of all modes of a ring.
class BesselModes {
public:
  BesselModes(double inner_radius, double outer_radius, double angular_velocity);

  /// 1 / sigma_k for real k >= 0. Beyond k = 64 by interpolation of k / sigma_k in panels that
  /// double in length.
  double compliance(double k) const;

  /// The compliance for a hub at r = 0, b / theta; it differs from the other by a factor
  /// 1 + O((a/b)^(2k)).
  double compliance_without_hub(double k) const;

  /// From this k on both agree to round-off.
  double hub_free_mode() const { return hub_fades_at; }

  /// R_k(r)/R_k(b) for every radius.
  std::vector<double> profile(double k, const std::vector<double>& radii) const;

private:
  double computed_compliance(double k) const;
  bool hub_matters(double k) const;

  /// k / sigma_k at the Gauss-Legendre points of the panels [64, 128], [128, 256], ...
  std::vector<std::vector<double>> panels;

  double a, b, omega;
  double hub_fades_at;
};

} // namespace rollwave
