#ifndef ROLLWAVE_CERTIFICATE_H
#define ROLLWAVE_CERTIFICATE_H

#include "feasible_trace.h"
#include "result.h"

#include <vector>

namespace rollwave {

struct Scene;
struct MeshSystem;

/**
 * A guaranteed bound of the error, without constants. With a displacement v that obeys v <= phi on
 * the whole contact zone, and a flux tau in equilibrium with the force and with a contact pressure
 * lambda >= 0 in the zone,
 *
 *     eta^2 = int r [ (tau_z - alpha v_z)^2 / alpha + (tau_r - v_r)^2 ] dr dz
 *             + 2 b int lambda (phi - v) dz
 *
 * obeys  J(v) - eta^2 / 2 <= J(u) <= J(v)  and  a(v - u, v - u) <= eta^2.
 *
 * v is the discrete displacement but for the cells at the surface, where the correction c(z) of
 * FeasibleTrace is added, fading linearly to the inner side of the cell. tau comes from
 * a DualPotential with AngularBubbles psi, in terms of which the first integral is
 *
 *     int [ r alpha (psi_s + v_z)^2 + r ((G - psi_z)/r - v_r)^2 ] dr dz.
 *
 * G = int_r^b rho f_0 drho is the integral of the force f or, where that is not uniform, of a
 * ForceInterpolant f_0, and (f_0, v) = int G v_r dr dz. With (f - f_0, w) <= epsilon |w| for all w,
 * |w|^2 = a(w, w), a(v - u, v - u)^(1/2) <= epsilon + eta by the triangle inequality, and the
 * bounds of J open accordingly. What Gauss' rules miss of G is added to eta, and opens the bounds
 * of J too: MissedMoment. Where nothing better is known of w there is Friedrichs' inequality
 *
 *     ||w|| <= C |w|,   C^2 = (b^2/2) ln(b/a) - (b^2 - a^2)/4,   ||w||^2 = int r w^2 dr dz.
 *
 * All integrals are taken by Gauss' rules that are exact for the polynomials in z, those along the
 * road with degree + 6 points, and between the ends of panels where G is no polynomial in z
 * (ForceLines). The bound assumes that these resolve phi; of a force that is no number, that the
 * points of choose_force_panels() see what it does, and those of MissedMoment along r what the
 * rules miss.
 */
struct Certificate {
  CertifiedError error;            ///< the bounds
  std::vector<double> cell_bounds; ///< eta of each active cell; their squares add up to eta^2
  FeasibleTrace trace;             ///< v on the surface
  double energy;                   ///< J(v) with f_0 in place of f
  double work_of_rest;             ///< (f_0, v - u_h), u_h the displacement certified
};

/// Certifies the solution @p contact with the displacement @p field. @p system is that of the same
/// space, with the load of the scene. Its dual parts are prepared here when it lacks them, and
/// dropped unless the system is kept.
/// @throws as prepare_certificate(), NotSolved when an iteration fails.
Certificate certify(const RingSpace& space, const Scene& scene, const ContactProblem& problem,
                    const ContactSolution& contact, const FieldVector& field, MeshSystem& system,
                    Work& work);

} // namespace rollwave

#endif
