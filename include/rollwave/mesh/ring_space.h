#pragma once

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_cartesian.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <map>
#include <memory>
#include <optional>
#include <utility>
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

  double cell_ratio = 0; ///< height over width, the larger one of the cells on both sides
};

/// An edge of a cell on r = b with the nodes on it, at Gauss-Lobatto points from begin to end.
struct SurfaceEdge {
  double begin; ///< angle, in the range of SurfaceNode::angle
  double end;
  std::vector<unsigned int> nodes; ///< numbers among RingSpace::surface_nodes()
};

/**
 * Continuous elements of one degree in (r, z): degrees of freedom, constraints (hanging nodes,
 * period, u = 0 on the hub) and the nodes on the surface. On several processes each has the degrees
 * of freedom and constraints of its cells and of those next to them, and the surface in full.
 */
class RingSpace {
public:
  /// @param scene whose zone is in the middle of the range of the surface nodes' angles
  RingSpace(const dealii::Triangulation<2>& triangulation, const Scene& scene, unsigned int degree);

  const dealii::DoFHandler<2>& dof_handler() const { return handler; }
  const dealii::AffineConstraints<double>& constraints() const { return affine_constraints; }

  /// Cells are rectangles in (r, z).
  const dealii::MappingCartesian<2>& mapping() const { return cartesian; }

  /// b, a length.
  double outer_radius() const { return radius; }

  /// The processes that share the space.
  MPI_Comm communicator() const { return handler.get_communicator(); }

  /// Unknowns: degrees of freedom without those that constraints tie to others.
  unsigned int n_unknowns() const { return unknowns; }

  /// The least and the largest diameter of a cell, (h_r^2 + b^2 h_z^2)^(1/2).
  std::pair<double, double> diameters() const;

  /// All nodes on r = b by increasing angle.
  const std::vector<SurfaceNode>& surface_nodes() const { return surface; }

  /// All edges on r = b by increasing angle of the mesh, beginning at the seam.
  const std::vector<SurfaceEdge>& surface_edges() const { return edges_of_surface; }

  /// The number among surface_edges() of the edge of a cell on r = b, if it has one.
  std::optional<unsigned int>
  surface_edge(const dealii::Triangulation<2>::active_cell_iterator& cell) const;

  /// The values of a field at the surface nodes, on every process.
  std::vector<double> surface_values(const FieldVector& field) const;

  /// The degrees of freedom of the cells of this process in the order of dissect().
  const std::vector<dealii::types::global_dof_index>& elimination_order() const { return order; }

  /// The degrees of freedom whose values a process may ask for: those of its cells and of the cells
  /// next to them, and what constraints tie these to.
  const dealii::IndexSet& relevant_dofs() const { return relevant; }

  /// The number of one of the relevant degrees of freedom among these, by which
  /// FieldVector::local_element() gives its value. Those that this process owns come first.
  unsigned int local_index(dealii::types::global_dof_index dof) const {
    return partitioner->global_to_local(dof);
  }
  unsigned int n_local() const {
    return partitioner->locally_owned_size() + partitioner->n_ghost_indices();
  }

  /// A zero field.
  FieldVector make_field() const { return FieldVector(partitioner); }

private:
  void find_surface(const Scene& scene);

  double radius;
  dealii::FE_Q<2> element;
  dealii::MappingCartesian<2> cartesian;
  dealii::DoFHandler<2> handler;
  dealii::AffineConstraints<double> affine_constraints;
  dealii::IndexSet relevant;
  std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner; ///< of fields
  unsigned int unknowns;
  std::vector<SurfaceNode> surface;
  std::vector<SurfaceEdge> edges_of_surface;
  std::map<double, unsigned int> edge_from;           ///< by the angle on the mesh where it begins
  std::vector<dealii::types::global_dof_index> order; ///< of elimination
};

/// The degrees of freedom of a cell with elements of degree p by their places: that of node (i, j)
/// in (r, z) has the number i + (p + 1) j.
class LexicographicDofs {
public:
  explicit LexicographicDofs(const dealii::DoFHandler<2>& handler)
      : numbering(dynamic_cast<const dealii::FE_Q<2>&>(handler.get_fe())
                      .get_poly_space_numbering_inverse()),
        hierarchic(numbering.size()), lexicographic(numbering.size()) {}

  /// @return valid until the next call
  const std::vector<dealii::types::global_dof_index>&
  of(const dealii::DoFHandler<2>::active_cell_iterator& cell) {
    cell->get_dof_indices(hierarchic);
    for (std::size_t i = 0; i < numbering.size(); ++i)
      lexicographic[i] = hierarchic[numbering[i]];
    return lexicographic;
  }

private:
  const std::vector<unsigned int> numbering;
  std::vector<dealii::types::global_dof_index> hierarchic, lexicographic;
};

/// The active cells beyond a face, over the seam as well: none, one or two.
std::vector<dealii::DoFHandler<2>::active_cell_iterator>
neighbours(const dealii::DoFHandler<2>::active_cell_iterator& cell, unsigned int face);

} // namespace rollwave
