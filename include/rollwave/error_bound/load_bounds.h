#pragma once

#include "rollwave/exact/bessel_modes.h"

#include <array>

namespace rollwave {

struct Scene;

/// An interval that contains an exact number.
struct Interval {
  double lower;
  double upper;
};

/// Intervals of Loads::total and Loads::vertical.
struct LoadBounds {
  Interval total;
  Interval vertical;
};

/**
 * The function w = R(r) cos(k x), x = z - 3 pi/2, that measures a load. R is the BesselMode with
 * R(a) = 0 and R(b) = 1, so that for the exact pressure lambda and every displacement v
 *
 *     b int lambda cos(k x) dz = (f, w) - a(u, w),     a(v, w) = b sigma_k int v(b, z) cos(k x) dz.
 *
 * k = 0 gives the contact force F, k = 1 the vertical load.
 */
class LoadFunction {
public:
  /// @param k 0 or 1
  LoadFunction(const Scene& scene, unsigned int k);

  double on_surface(double z) const;                               ///< cos(k x)
  double radial_slope(double r) const { return mode.at(r).slope; } ///< R'(r)
  double flux() const { return outer_radius / mode.compliance(); } ///< b sigma_k
  double norm_squared() const;                                     ///< a(w, w)

private:
  unsigned int k;
  double outer_radius;
  BesselMode mode;
};

/// The functions of both loads.
using LoadFunctions = std::array<LoadFunction, 2>;
LoadFunctions load_functions(const Scene& scene);

/// Integrals with a function w of a load, and sums of them.
struct LoadIntegrals {
  long double trace = 0;         ///< int v w dz on r = b
  long double pressure = 0;      ///< b int lambda w dz on r = b
  long double work_of_force = 0; ///< int Q_h w_r dr dz
};

/**
 * An interval of the load of @p w. With the flux tau of the Certificate, lambda_h its pressure and
 * lambda the exact one, A = diag(1, alpha) in (r, z), and norms of fluxes with the weight r A^(-1),
 *
 *     eta^2 = |A grad v - A grad u|^2 + |A grad u - tau|^2
 *             + 2 b int lambda_h (phi - u) dz + 2 b int lambda (phi - v) dz,
 *
 * and all four terms are >= 0. The mean of A grad v and tau is therefore within
 * rho = (eta^2 + R)^(1/2) / 2 of A grad u, R = 2 b int lambda_h (phi - v) dz, and gives
 *
 *     F* = ((f, w) - a(v, w) + b int lambda_h w dz) / 2,     |F - F*| <= rho |w|.
 *
 * If Q_h misses the force by delta, the radius grows by 2 delta |w|.
 *
 * @param radius rho + 2 delta
 * @param round_off relative error of the integrals
 * @param size of the solution, |v|
 */
Interval bound_load(const LoadFunction& w, const LoadIntegrals& integrals, double radius,
                    double size, double round_off);

} // namespace rollwave
