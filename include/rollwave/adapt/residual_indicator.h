#ifndef ROLLWAVE_ADAPT_RESIDUAL_INDICATOR_H
#define ROLLWAVE_ADAPT_RESIDUAL_INDICATOR_H

#include "rollwave/contact/contact_problem.h"

#include <vector>

namespace rollwave {

struct Scene;

/**
 * An indicator eta_K of the certified error in the energy norm on each active cell K, 0 on those of
 * other processes. It is of residual type, with the contact terms of R. Krause, A. Veeser and M.
 * Walloth (Numer. Math. 130 (2015) 151-197), and knows what the certificate cannot represent
 * without solving for it:
 *
 *     eta_K^2 = int_K H^2 (r f + r alpha u_zz + (r u_r)_r)^2 dr dz
 *             + sum over faces of int H^2 / (2 h_n) [flux]^2,  flux = r u_r or r alpha u_z
 *             + on r = b:  int H^2 / h_r b^2 (u_r + lambda)^2 dz
 *             + w int_K r (P_z u_r)^2 + r alpha (P_r u_z)^2 dr dz
 *             + w off full contact:  2 b int lambda (phi - u)^+ dz,
 *               int (b / h_r + ...) of the penetration c = (u - phi)^+: the energy of c xi(r), xi
 *               linear from 0 to 1 across the cell.
 *
 * lambda is the discrete pressure, h_n the side across the face. H turns a residual into the energy
 * of what the cell cannot resolve: H^2 = h_r^2 / r for the part that varies in r only, h_z^2 /
 * (alpha r), but at most (b - a)^2 / r, for the part that varies in z only, the lesser of both for
 * all else. Cells square in (r, z) are long in z near the surface at the critical speed, and their
 * residuals would be misjudged by any one length.
 *
 * P_z and P_r take the highest mode in z, or r: the fluxes (r alpha u_z, r u_r) have it, those of a
 * potential of the same degree (StressFunction) do not. w makes up for the residuals' squares being
 * larger than those of the errors. The sum has no guaranteed constant: it tells where to refine,
 * not how large the error is.
 */
std::vector<double> residual_indicator(const RingSpace& space, const Scene& scene,
                                       const ContactProblem& problem,
                                       const ContactSolution& contact, const FieldVector& field);

/// Jumps of the normal derivative, deal.II's KellyErrorEstimator, for each active cell. It ignores
/// alpha, the force and the contact; for comparison only.
std::vector<double> kelly_indicator(const RingSpace& space, const FieldVector& field);

} // namespace rollwave

#endif
