#ifndef ROLLWAVE_RESIDUAL_INDICATOR_H
#define ROLLWAVE_RESIDUAL_INDICATOR_H

#include "contact_solver.h"

#include <vector>

namespace rollwave {

struct Scene;

/**
 * An indicator eta_K of the error in the energy norm on each active cell K, of residual type, with
 * the contact terms of R. Krause, A. Veeser and M. Walloth (Numer. Math. 130 (2015) 151-197). With
 * the sides h_r and h_z of a cell and H^2 = max(h_r^2, h_z^2 / alpha) / r at its centre, by which
 * the energy norm bounds what the cell cannot resolve,
 *
 *     eta_K^2 = H^2 int_K (r f + r alpha u_zz + (r u_r)_r)^2 dr dz
 *             + sum over faces of H^2 / (2 h_n) int [flux]^2,  flux = r u_r or r alpha u_z
 *             + on r = b:  H^2 / h_r int b^2 (u_r + lambda)^2 dz
 *             + off full contact:  2 b int lambda (phi - u)^+ dz,
 *               int (b / h_r + ...) of the penetration c = (u - phi)^+: the energy of c xi(r), xi
 *               linear from 0 to 1 across the cell,
 *
 * where h_n is the side across the face, lambda the discrete pressure. It has no guaranteed
 * constant: it tells where to refine, not how large the error is.
 */
std::vector<double> residual_indicator(const RingSpace& space, const Scene& scene,
                                       const ContactProblem& problem,
                                       const ContactSolution& contact, const FieldVector& field);

} // namespace rollwave

#endif
