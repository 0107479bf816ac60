#ifndef ROLLWAVE_ERROR_BOUND_STRESS_FUNCTION_CONSTRAINTS_H
#define ROLLWAVE_ERROR_BOUND_STRESS_FUNCTION_CONSTRAINTS_H

#include "rollwave/error_bound/admissible_pressure.h"
#include "rollwave/mesh/ring_space.h"

#include <deal.II/lac/affine_constraints.h>

#include <vector>

namespace rollwave {

struct Scene;

/**
 * What ties the nodal values of a potential psi: on r = b the primitive of b lambda, zero where the
 * seam begins; continuous over hanging nodes and, but for the growth b int lambda dz in a period,
 * over the seam. Nodes on the finer side of an edge follow those of the coarser side by the shapes
 * of StressFunctionBasis, deal.II's own constraints being for polynomials only.
 *
 * @param pressures one for each of RingSpace::surface_faces(); for degree 1 with zero slopes
 */
dealii::AffineConstraints<double>
stress_function_constraints(const RingSpace& space, const Scene& scene,
                            const std::vector<EdgePressure>& pressures);

} // namespace rollwave

#endif
