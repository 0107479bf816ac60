#ifndef ROLLWAVE_EDGE_CONSTRAINTS_H
#define ROLLWAVE_EDGE_CONSTRAINTS_H

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include <functional>

namespace rollwave {

/// Where the radius r lies between @p begin and @p end, from 0 to 1, in terms of a coordinate that
/// grows or falls with r.
using RadialPlace = std::function<double(double r, double begin, double end)>;

/**
 * Adds the constraints that make a function continuous over hanging nodes and, up to a constant,
 * over the seam: u(r, z + 2 pi) = u(r, z) + @p growth. On each cell u is a polynomial in z and in a
 * coordinate of r in which @p place measures; cells need not be cut at their middle in that
 * coordinate, as deal.II's own constraints assume.
 *
 * The nodes on the finer side of an edge follow those of the coarser side. On the seam, vertices of
 * the second side follow those of the first. Degrees of freedom that are constrained already are
 * left as they are.
 */
void tie_edges(const dealii::DoFHandler<2>& handler, const RadialPlace& place, double growth,
               dealii::AffineConstraints<double>& constraints);

/// The nodes on an edge from its first vertex to its second.
std::vector<dealii::types::global_dof_index>
dofs_on_edge(const dealii::DoFHandler<2>::face_iterator& face, unsigned int degree);

} // namespace rollwave

#endif
