#pragma once

#include "rollwave/scene/road.h"

#include <complex>
#include <vector>

namespace rollwave {

/**
 * A limit for displacements of finite energy, phi_v <= phi.
 *
 * Towards the tangent of a drum, at the angle x_t, phi grows like C - (x_t - x)^(1/2). A trace with
 * that slope has no displacement of finite energy. From the angle x_c = x_t - D on, phi_v is
 * therefore the straight line that touches phi at x_c, as far as it lies below the constant value
 * of phi beyond x_t. phi is convex on |x| < x_t, so that the line lies below it: with
 * h = c + 1/kappa, R = 1/kappa and g = (R^2 - h^2 sin^2 x)^(1/2), phi + b = h cos x - g and
 *
 *     phi'' = h cos x (h cos x - g) / g + h^2 sin^2 x (h^2 cos^2 x - g^2) / g^3 >= 0,
 *
 * since h cos x >= g. On other roads phi_v = phi. All angles z are those of a scene.
 */
class AdmissibleRoad {
public:
  /// @param phi of the road
  /// @param reach D is an eighth of this angle, or of x_t if that is less
  AdmissibleRoad(const Road& road, const Obstacle& phi, double reach);

  struct ValueAndSlope {
    double value; ///< a length
    double slope; ///< d/dz, a length
  };

  /// phi_v
  ValueAndSlope limit(double z) const;

  /// An upper bound of phi: phi, but on x_c < |x| < x_t the chord between its ends.
  double upper(double z) const;

  /// The angles x in (-pi, pi) at which limit() or upper() is not smooth.
  std::vector<double> corners() const;

  /**
   * True if Gauss' rule with a few points more than a polynomial needs is exact to round-off for
   * phi between two angles without a corner in between: the nearest singularity of phi, in the
   * complex plane too, lies outside of Bernstein's ellipse of the interval whose semi-axes add up
   * to 6 of its half-lengths.
   */
  bool is_resolved(double begin, double end) const;

private:
  // Without a tangent x_t and x_c are pi, and the other numbers are not used.
  Road road;
  Obstacle phi;
  double tangent;          ///< x_t
  double last_contact;     ///< x_c
  double value_at_last;    ///< phi(x_c)
  double slope_at_last;    ///< phi'(x_c)
  double value_at_tangent; ///< phi(x_t), from inside
  double value_beyond;     ///< phi for |x| > x_t

  std::complex<double> singular; ///< the place where phi is singular, as are -x and pi - x
};

} // namespace rollwave
