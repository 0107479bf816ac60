#include "edge_constraints.h"

#include "radial_shapes.h"
#include "ring_mesh.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe.h>

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

namespace {

using Dof = types::global_dof_index;

/// An edge with its nodes from the first vertex to the second.
struct Edge {
  double begin; ///< radii of its vertices
  double end;
  std::vector<Dof> dofs;
};

Edge edge_of(const DoFHandler<2>::face_iterator& face, unsigned int degree) {
  return {face->vertex(0)[0], face->vertex(1)[0], dofs_on_edge(face, degree)};
}

class EdgeTies {
public:
  EdgeTies(unsigned int degree, const RadialPlace& place, AffineConstraints<double>& constraints)
      : degree(degree), place(place), shapes(lobatto_lagrange(degree)),
        nodes(QGaussLobatto<1>(degree + 1).get_points()), constraints(constraints) {}

  void tie_hanging_nodes(const DoFHandler<2>::face_iterator& face, bool is_radial) {
    const Edge coarse = edge_of(face, degree);
    const double middle =
        is_radial ? place(face->child(0)->vertex(1)[0], coarse.begin, coarse.end) : 0.5;
    tie(edge_of(face->child(0), degree), 0, middle, coarse, 0);
    tie(edge_of(face->child(1), degree), middle, 1, coarse, 0);
  }

  void tie_seam(std::vector<Edge> first, std::vector<Edge> second, double growth) {
    for (auto* const side : {&first, &second})
      std::sort(side->begin(), side->end(),
                [](const Edge& left, const Edge& right) { return left.begin < right.begin; });
    for (std::size_t i = 0, j = 0; i < first.size() && j < second.size();) {
      const Edge &one = first[i], &other = second[j];
      if (one.begin == other.begin)
        tie(other.dofs.front(), one.dofs.front(), growth);
      if (one.end == other.end)
        tie(other.dofs.back(), one.dofs.back(), growth);
      if (one.begin <= other.begin && other.end <= one.end)
        tie(other, place_on(one, other.begin), place_on(one, other.end), one, growth);
      else
        tie(one, place_on(other, one.begin), place_on(other, one.end), other, -growth);
      const bool first_ends = one.end <= other.end, second_ends = other.end <= one.end;
      i += first_ends;
      j += second_ends;
    }
  }

private:
  double place_on(const Edge& edge, double r) const {
    if (r == edge.begin || r == edge.end)
      return r == edge.begin ? 0 : 1;
    return place(r, edge.begin, edge.end);
  }

  void tie(Dof dof, Dof master, double offset) {
    if (constraints.is_constrained(dof))
      return;
    constraints.add_line(dof);
    constraints.add_entry(dof, master, 1);
    constraints.set_inhomogeneity(dof, offset);
  }

  /// Ties the nodes of an edge that reaches from @p t_begin to @p t_end on a coarser one to the
  /// nodes of the latter. Vertices that both share are left.
  void tie(const Edge& fine, double t_begin, double t_end, const Edge& coarse, double offset) {
    for (unsigned int k = 0; k <= degree; ++k) {
      const double t = k == degree ? t_end : t_begin + (t_end - t_begin) * nodes[k][0];
      if (t == 0 || t == 1 || constraints.is_constrained(fine.dofs[k]))
        continue;
      constraints.add_line(fine.dofs[k]);
      constraints.set_inhomogeneity(fine.dofs[k], offset);
      for (unsigned int j = 0; j <= degree; ++j) {
        // A node that is one of the coarser edge depends on no other but for round-off.
        const double weight = shapes[j].value(t);
        if (std::abs(weight) > 1e-14)
          constraints.add_entry(fine.dofs[k], coarse.dofs[j], weight);
      }
    }
  }

  const unsigned int degree;
  const RadialPlace& place;
  const std::vector<Polynomials::Polynomial<double>> shapes;
  const std::vector<Point<1>> nodes;
  AffineConstraints<double>& constraints;
};

} // namespace

std::vector<Dof> dofs_on_edge(const DoFHandler<2>::face_iterator& face, unsigned int degree) {
  std::vector<Dof> dofs = {face->vertex_dof_index(0, 0)};
  for (unsigned int i = 0; i + 1 < degree; ++i)
    dofs.push_back(face->dof_index(i));
  dofs.push_back(face->vertex_dof_index(1, 0));
  return dofs;
}

void tie_edges(const DoFHandler<2>& handler, const RadialPlace& place, double growth,
               AffineConstraints<double>& constraints) {
  const unsigned int degree = handler.get_fe().degree;
  EdgeTies ties(degree, place, constraints);
  std::vector<Edge> seam_begin, seam_end;
  for (const auto& cell : handler.active_cell_iterators())
    for (const unsigned int f : cell->face_indices()) {
      const auto face = cell->face(f);
      if (face->has_children())
        ties.tie_hanging_nodes(face, /*is_radial=*/f >= 2);
      else if (face->at_boundary() && face->boundary_id() == seam_begin_id)
        seam_begin.push_back(edge_of(face, degree));
      else if (face->at_boundary() && face->boundary_id() == seam_end_id)
        seam_end.push_back(edge_of(face, degree));
    }
  ties.tie_seam(std::move(seam_begin), std::move(seam_end), growth);
}

} // namespace rollwave
