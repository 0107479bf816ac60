#ifndef ROLLWAVE_ERROR_BOUND_STRESS_FUNCTION_CONSTRAINTS_H
#define ROLLWAVE_ERROR_BOUND_STRESS_FUNCTION_CONSTRAINTS_H

#include "rollwave/mesh/ring_space.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include <functional>
#include <vector>

namespace rollwave {

/// The values at the radius r of the radial shape functions on the interval from @p begin to @p
/// end.
using RadialShapeValues = std::function<std::vector<double>(double r, double begin, double end)>;

/**
 * Adds the constraints that make a function continuous over hanging nodes and, up to a constant,
 * over the seam: u(r, z + 2 pi) = u(r, z) + @p growth. On each
 * cell u is a combination of products of polynomials in z and the functions of r that @p shapes
 * evaluates, with nodes at Gauss-Lobatto points in both directions; deal.II's own constraints are
 * for polynomials only.
 *
 * The nodes on the finer side of an edge follow those of the coarser side. On the seam, vertices of
 * the second side follow those of the first. Degrees of freedom that are constrained already are
 * left as they are.
 */
void tie_edges(const RingSpace& space, const RadialShapeValues& shapes, double growth,
               dealii::AffineConstraints<double>& constraints);

/// The nodes on an edge from its first vertex to its second.
std::vector<dealii::types::global_dof_index>
dofs_on_edge(const dealii::DoFHandler<2>::face_iterator& face, unsigned int degree);

} // namespace rollwave

#endif
