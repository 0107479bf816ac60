#pragma once

#include "rollwave/error_bound/admissible_displacement.h"
#include "rollwave/error_bound/load_bounds.h"

#include <optional>
#include <vector>

namespace rollwave {

struct Scene;
class ForceIntegral;
class DualSystem;
class RunStatistics;

/// Section `Certificate`.
struct CertificateOptions {
  bool error_bound = true;
};

/// The numbers that a Certificate guarantees; a bound that does not exist is infinite.
struct CertifiedError {
  double energy_norm; ///< upper bound of sqrt(a(u_h - u, u_h - u))
  double force_data;  ///< delta, the part of energy_norm for the difference of Q and Q_h
  double relative;    ///< upper bound of the same over sqrt(a(u, u)); infinite if not known
  double lower_bound; ///< of J(u)
  double upper_bound; ///< of J(u), the energy J(v)
  LoadBounds loads;
  double eta;          ///< as in Certificate
  double norm_squared; ///< a(v, v)

  /// Features of a force expression that are smaller than this length may be undetected; nullopt
  /// without such a force.
  std::optional<double> sampled_width;
};

/**
 * An upper bound of e = |u - u_h|, |w|^2 = a(w, w), for u_h that may lie above the road between
 * nodes. With an admissible v and a flux tau in equilibrium with the pressure lambda, exact flux
 * sigma and exact pressure lambda*, let x = |u - v| and y = |sigma - tau| in the norm of A^(-1),
 * A = diag(1, alpha) in (r, z), so that x^2 + y^2 <= eta^2. Then
 *
 *     e <= x + d,                    d = |v - u_h|,
 *     e^2 <= eta_0 e + R + y d,      eta_0 = |tau - A grad u_h|,   R = b int lambda (phi - v) dz,
 *
 * the latter since int (sigma - tau) grad w = b int (lambda - lambda*) w dz for every w that
 * vanishes on the hub. The bound is the largest value of the smaller one over all x and y.
 *
 * @param gap_work R @param moved d
 * @return at most eta + d
 */
double bound_of_discrete(double eta, double eta_0, double gap_work, double moved);

/**
 * A guaranteed bound of the error, without constants. With a displacement v that obeys v <= phi on
 * the whole contact zone, and a flux tau in equilibrium with the force and with a contact pressure
 * lambda >= 0 in the zone,
 *
 *     eta^2 = int r [ (tau_z - alpha v_z)^2 / alpha + (tau_r - v_r)^2 ] dr dz
 *             + 2 b int lambda (phi - v) dz
 *
 * obeys  J(v) - eta^2 / 2 <= J(u) <= J(v)  and  a(v - u, v - u) <= eta^2. The error of u_h has the
 * bound of bound_of_discrete(). The loads have the intervals of bound_load().
 *
 * v is the discrete displacement except in the cells at the surface, where the correction c(z) of
 * AdmissibleTrace is added, fading linearly to the inner side of the cell. tau comes from
 * a stress function psi of the DualSystem, in terms of which the first integral is
 *
 *     int [ r alpha (psi_s + v_z)^2 + r ((Q_h - psi_z)/r - v_r)^2 ] dr dz,
 *
 * where s(r) = int_r^b rho alpha drho, so that psi_s = -psi_r / (r alpha).
 *
 * Q_h is that of ForceIntegral, which misses the force by no more than delta in the dual norm, so
 * that all bounds of errors grow by delta: the exact solution for Q_h is within delta of u. The
 * bounds of J open accordingly.
 *
 * All integrals are taken by Gauss' rules that are exact for the polynomials in z, and exact to
 * round-off on the pieces of AdmissibleTrace along the road. The bound assumes that the points of
 * ForceIntegral see what a force does.
 */
struct Certificate {
  CertifiedError error;            ///< the bounds
  std::vector<double> cell_bounds; ///< of each active cell; the squares add up to eta^2 + delta^2
  AdmissibleTrace trace;           ///< v on the surface
  double work_of_force;            ///< (f, v), by Q_h
};

/// Certifies a solution with the displacement @p field.
/// @param force that of the scene, nullptr without
/// @param dual of the same space and speed
Certificate certify(const SolvedContact& solved, const FieldVector& field,
                    const ForceIntegral* force, const DualSystem& dual, RunStatistics& statistics);

} // namespace rollwave
