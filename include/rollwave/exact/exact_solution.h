#pragma once

#include "rollwave/exact/exact_scene.h"
#include "rollwave/exact/gegenbauer_pressure.h"
#include "rollwave/scene/loads.h"

#include <mpi.h>

namespace rollwave {

/**
 * The semi-analytic solution of a contact problem, without any mesh. With x = z - 3 pi/2, the
 * pressure on |x| < w as a GegenbauerPressure of even terms, and the compliances c_k = 1/sigma_k
 * of BesselModes,
 *
 *     u(b, x)  = u_f(b) - sum_k c_k lambda_k e^(i k x),
 *     lambda_k = (1/2 pi) int lambda e^(-i k x) dx,
 *     u_f(r)   = f ( -(r^2 - a^2)/4 + (b^2/2) ln(r/a) ),
 *
 * has to equal phi on |x| < w. This is tested by the n functions of the series itself, which gives
 * a symmetric positive definite system for its coefficients, and by the next one, which gives the
 * half-width w: a wrong w would need a pressure that is singular at the ends. Where the zone cuts
 * the contact short, w is the zone's and the pressure is singular, with the exponent -s.
 */
struct ExactSolution {
  ExactScene scene;
  double half_width = 0; ///< w; 0 without contact
  Loads loads = {0, 0, 0};
  double energy = 0;       ///< J(u)
  double norm_squared = 0; ///< a(u, u)
  double peak_pressure = 0;

  /// Estimated relative errors: the numbers are limits of the growing series.
  double force_accuracy = 0;
  double energy_accuracy = 0;
  double half_width_accuracy = 0;

  /// Exponent of the pressure at the ends: 1 - s, or -s where the zone cuts the contact short.
  double end_exponent = 0.5;

  /// False near the critical speed, where the series does not resolve the law at the ends: F and J
  /// are accurate, the pressure at the ends is not.
  bool ends_resolved = true;

  /// lambda(z), of the longest series; identically zero without contact.
  GegenbauerPressure pressure = {lowest_point, 1, 1, {0.}};
};

/// All processes of @p communicator call it with the same scene.
/// @throws NotSolved when the series does not converge, Interrupted when the user ends it.
ExactSolution solve_exactly(const ExactScene& scene, MPI_Comm communicator = MPI_COMM_SELF);

} // namespace rollwave
