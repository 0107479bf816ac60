#ifndef ROLLWAVE_RING_SPACE_H
#define ROLLWAVE_RING_SPACE_H

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_cartesian.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <vector>

namespace rollwave {

struct Scene;

/// A field on the ring: one value for each degree of freedom.
using FieldVector = dealii::LinearAlgebra::distributed::Vector<double>;

/// A node on r = b. Over the seam only one of two coinciding nodes is listed.
struct SurfaceNode {
  dealii::types::global_dof_index dof;
  double angle; ///< z in [m - pi, m + pi), where m is the middle of the contact zone

  /// b times the node's Gauss-Lobatto weight, an area: [p, q]_h = sum_i weight_i p_i q_i is the
  /// integral of r p q over r = b by Gauss-Lobatto's rule with degree + 1 points, that is the
  /// trapezoidal rule for degree 1 and Simpson's for degree 2. Nodal force = weight * pressure.
  double weight;
};

/// An edge of a cell on r = b with the nodes on it, at Gauss-Lobatto points from begin to end.
struct SurfaceFace {
  dealii::DoFHandler<2>::active_cell_iterator cell;
  double begin; ///< angle, in the range of SurfaceNode::angle
  double end;
  std::vector<dealii::types::global_dof_index> dofs;
};

/**
 * Continuous elements of one degree in (r, z): degrees of freedom, constraints (hanging nodes,
 * period, u = 0 on the hub) and the nodes on the surface.
 */
class RingSpace {
public:
  /// @throws BadInput when no node of the mesh lies in the contact zone.
  RingSpace(const dealii::Triangulation<2>& triangulation, const Scene& scene, unsigned int degree);

  const dealii::DoFHandler<2>& dof_handler() const { return handler; }
  const dealii::AffineConstraints<double>& constraints() const { return affine_constraints; }

  /// Cells are rectangles in (r, z).
  const dealii::MappingCartesian<2>& mapping() const { return cartesian; }

  /// b, a length.
  double outer_radius() const { return radius; }

  /// Unknowns: degrees of freedom without those that constraints tie to others.
  unsigned int n_unknowns() const;

  /// All nodes on r = b by increasing angle.
  const std::vector<SurfaceNode>& surface_nodes() const { return surface; }

  /// All edges on r = b by increasing angle of the mesh, beginning at the seam.
  const std::vector<SurfaceFace>& surface_faces() const { return faces; }

  /// The nodes in [z0, z1], a stretch of surface_nodes().
  const std::vector<SurfaceNode>& contact_nodes() const { return contact; }

  /// All degrees of freedom in an order of elimination that keeps the factors of matrices on the
  /// space sparse, whatever their constraints: dissect().
  const std::vector<dealii::types::global_dof_index>& elimination_order() const { return order; }

  /// A zero field.
  FieldVector make_field() const { return FieldVector(handler.n_dofs()); }

private:
  void find_surface_nodes(const Scene& scene);

  double radius;
  dealii::FE_Q<2> element;
  dealii::MappingCartesian<2> cartesian;
  dealii::DoFHandler<2> handler;
  dealii::AffineConstraints<double> affine_constraints;
  std::vector<SurfaceNode> surface;
  std::vector<SurfaceNode> contact;
  std::vector<SurfaceFace> faces;
  std::vector<dealii::types::global_dof_index> order;
};

} // namespace rollwave

#endif
