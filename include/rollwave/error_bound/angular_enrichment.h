#ifndef ROLLWAVE_ERROR_BOUND_ANGULAR_ENRICHMENT_H
#define ROLLWAVE_ERROR_BOUND_ANGULAR_ENRICHMENT_H

#include "rollwave/error_bound/stress_function.h"

#include <vector>

namespace rollwave {

struct EnrichmentColumns;

/**
 * What enriches a potential psi of degree p (StressFunction) by one degree in z, and the contact
 * pressures lambda with it. On each cell
 *
 *     psi + h_z beta(t) g(r),   beta(t) = int_0^t P,   P the orthonormal Legendre polynomial of
 *     degree p on [0, 1],   t = (z - begin) / h_z,   g a combination of StressFunctionBasis,
 *
 * so that psi_z gains the mode g(r) P(t), which r u_r of a displacement of degree p has and psi_z
 * has not: without it the bound on cells that are long in z is several times the error. beta
 * vanishes at both ends and at the nodes. g is continuous between cells of the same length, zero
 * where their lengths differ, free on the hub, and b m on r = b, where the pressure becomes lambda
 * + m P.
 *
 * g and m maximise D(tau) with psi as it is and lambda + m P >= 0: a banded system for each
 * column of cells of one length, and conjugate gradients where processes share a column.
 */
class AngularEnrichment {
public:
  /// @param pressures one for each of RingSpace::surface_faces()
  /// @param force nullptr when G is a function of r, which does no work with them
  AngularEnrichment(const RingSpace& space, const Scene& scene, RadialShapesOfMesh& shapes,
                    const FieldVector& potential, const std::vector<EdgePressure>& pressures,
                    const ForceIntegral* force, const EnrichmentColumns& columns);

  /// g at the radial Gauss-Lobatto points of a cell with the degrees of freedom @p dofs, the radial
  /// index running fastest.
  void values(const std::vector<dealii::types::global_dof_index>& dofs,
              std::vector<double>& g) const;

  /// P for elements of a degree.
  static dealii::Polynomials::Polynomial<double> mode(unsigned int degree);

private:
  unsigned int n;    ///< degree + 1
  FieldVector field; ///< g, at the first node of each cell's angular nodes that only it has
};

} // namespace rollwave

#endif
