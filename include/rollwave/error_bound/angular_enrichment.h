#ifndef ROLLWAVE_ERROR_BOUND_ANGULAR_ENRICHMENT_H
#define ROLLWAVE_ERROR_BOUND_ANGULAR_ENRICHMENT_H

#include "rollwave/error_bound/admissible_pressure.h"
#include "rollwave/error_bound/force_integral.h"
#include "rollwave/error_bound/radial_shapes.h"
#include "rollwave/mesh/ring_space.h"

#include <deal.II/base/polynomial.h>

#include <vector>

namespace rollwave {

struct Scene;

/**
 * What enriches a potential psi of degree p (StressFunction) by one degree in z, and the contact
 * pressures lambda with it. On each cell
 *
 *     psi + h_z beta(t) g(r),   beta(t) = int_0^t P,   P the orthonormal Legendre polynomial of
 *     degree p on [0, 1],   t = (z - begin) / h_z,   g a combination of StressFunctionBasis,
 *
 * so that psi_z gains the mode g(r) P(t), which r u_r of a displacement of degree p has and psi_z
 * has not: without it the bound on cells that are long in z is several times the error.
 *
 * beta vanishes at both ends, so that columns of cells of one length are independent of each other.
 * g is continuous in a column, free on the hub, zero where the column ends inside of the ring, and
 * b m on r = b, where the pressure becomes lambda + m P. g and m maximise D(tau) with psi as it is
 * and lambda + m P >= 0.
 *
 * @param pressures one for each of RingSpace::surface_faces()
 * @param force nullptr when G is a function of r, which does no work with them
 * @return g at the radial Gauss-Lobatto points of each active cell, one cell after another
 */
std::vector<double> angular_enrichment(const RingSpace& space, const Scene& scene,
                                       RadialShapesOfMesh& shapes, const FieldVector& potential,
                                       const std::vector<EdgePressure>& pressures,
                                       const ForceIntegral* force);

/// P for elements of a degree.
dealii::Polynomials::Polynomial<double> angular_mode(unsigned int degree);

} // namespace rollwave

#endif
