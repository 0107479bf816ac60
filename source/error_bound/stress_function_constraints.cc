#include "rollwave/error_bound/stress_function_constraints.h"

#include "rollwave/error_bound/radial_shapes.h"
#include "rollwave/mesh/interval_map.h"
#include "rollwave/mesh/tensor_elements.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe.h>
#include <deal.II/grid/tria.h>

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
  Edge edge = {face->vertex(0)[0], face->vertex(1)[0], {face->vertex_dof_index(0, 0)}};
  for (unsigned int i = 0; i + 1 < degree; ++i)
    edge.dofs.push_back(face->dof_index(i));
  edge.dofs.push_back(face->vertex_dof_index(1, 0));
  return edge;
}

class EdgeTies {
public:
  EdgeTies(const Scene& scene, unsigned int degree, AffineConstraints<double>& constraints)
      : scene(scene), degree(degree), polynomials(lobatto_lagrange(degree)),
        nodes(QGaussLobatto<1>(degree + 1).get_points()), constraints(constraints) {}

  /// Those on the face @p f of a cell that has finer neighbours there.
  void tie_hanging_nodes(const DoFHandler<2>::active_cell_iterator& cell, unsigned int f) {
    const auto face = cell->face(f);
    const bool is_radial = f >= 2;
    const Edge coarse = edge_of(face, degree);
    for (const unsigned int half : {0U, 1U}) {
      // Beyond the cells next to its own a process knows no degrees of freedom.
      if (cell->neighbor_child_on_subface(f, half)->is_artificial())
        continue;
      const Edge fine = edge_of(face->child(half), degree);
      if (is_radial)
        tie(fine, coarse, 0);
      else
        for (unsigned int k = 0; k <= degree; ++k) {
          Vector<double> weights(degree + 1);
          for (unsigned int j = 0; j <= degree; ++j)
            weights[j] = polynomials[j].value((half + nodes[k][0]) / 2);
          if (k != degree * half)
            tie(fine.dofs[k], coarse.dofs, weights, 0);
        }
    }
  }

  void tie_seam(std::vector<Edge> first, std::vector<Edge> second, double growth) {
    for (auto* const side : {&first, &second})
      std::sort(side->begin(), side->end(),
                [](const Edge& left, const Edge& right) { return left.begin < right.begin; });
    Vector<double> unity(1);
    unity = 1;
    for (std::size_t i = 0, j = 0; i < first.size() && j < second.size();) {
      const Edge &one = first[i], &other = second[j];
      // A process may know an edge and not the one across the seam, which it then has no use for.
      if (one.end <= other.begin || other.end <= one.begin) {
        one.end <= other.begin ? ++i : ++j;
        continue;
      }
      if (one.begin == other.begin)
        tie(other.dofs.front(), {one.dofs.front()}, unity, growth);
      if (one.end == other.end)
        tie(other.dofs.back(), {one.dofs.back()}, unity, growth);
      if (one.begin <= other.begin && other.end <= one.end)
        tie(other, one, growth);
      else
        tie(one, other, -growth);
      const bool first_ends = one.end <= other.end, second_ends = other.end <= one.end;
      i += first_ends;
      j += second_ends;
    }
  }

private:
  /// Ties the nodes of a radial edge to those of another that is as long or longer. Vertices that
  /// both share are left.
  void tie(const Edge& fine, const Edge& coarse, double offset) {
    const StressFunctionBasis& basis = bases.at(coarse.begin, coarse.end, [&] {
      return StressFunctionBasis(scene, degree, coarse.begin, coarse.end);
    });
    for (unsigned int k = 0; k <= degree; ++k) {
      const double r = k == degree ? fine.end : fine.begin + nodes[k][0] * (fine.end - fine.begin);
      if (r != coarse.begin && r != coarse.end)
        tie(fine.dofs[k], coarse.dofs, basis.values(r), offset);
    }
  }

  void tie(Dof dof, const std::vector<Dof>& masters, const Vector<double>& weights, double offset) {
    if (constraints.is_constrained(dof))
      return;
    constraints.add_line(dof);
    constraints.set_inhomogeneity(dof, offset);
    for (unsigned int j = 0; j < masters.size(); ++j)
      // A node that is one of the masters depends on no other but for round-off.
      if (std::abs(weights[j]) > 1e-13)
        constraints.add_entry(dof, masters[j], weights[j]);
  }

  const Scene& scene;
  const unsigned int degree;
  const std::vector<Polynomials::Polynomial<double>> polynomials;
  const std::vector<Point<1>> nodes;
  AffineConstraints<double>& constraints;
  IntervalMap<StressFunctionBasis> bases;
};

/// Gives psi on r = b; returns by how much it grows in a period.
double fix_surface(const RingSpace& space, const std::vector<EdgePressure>& pressures,
                   AffineConstraints<double>& constraints) {
  const unsigned int degree = space.dof_handler().get_fe().degree;
  const QGaussLobatto<1> nodes(degree + 1);
  const auto area = [&](unsigned int edge) {
    return space.outer_radius() *
           (space.surface_faces()[edge].end - space.surface_faces()[edge].begin);
  };
  std::vector<double> at_begin = {0}; // of each edge
  for (unsigned int edge = 0; edge < pressures.size(); ++edge)
    at_begin.push_back(at_begin.back() + area(edge) * pressures[edge].mean);
  for (const auto& cell : space.outer_cells())
    if (const auto edge = space.surface_face(cell)) {
      // Not SurfaceFace::nodes, in which both sides of the seam are one.
      const std::vector<Dof> dofs = edge_of(cell->face(1), degree).dofs;
      for (unsigned int k = 0; k <= degree; ++k) {
        const double t = nodes.point(k)[0];
        const auto& [mean, slope] = pressures[*edge];
        constraints.add_line(dofs[k]);
        constraints.set_inhomogeneity(dofs[k], at_begin[*edge] +
                                                   area(*edge) * t * (mean - slope * (1 - t) / 2));
      }
    }
  return at_begin.back();
}

} // namespace

AffineConstraints<double> stress_function_constraints(const RingSpace& space, const Scene& scene,
                                                      const std::vector<EdgePressure>& pressures) {
  const DoFHandler<2>& handler = space.dof_handler();
  const unsigned int degree = handler.get_fe().degree;
  AffineConstraints<double> constraints(space.relevant_dofs());
  const double growth = fix_surface(space, pressures, constraints);
  EdgeTies ties(scene, degree, constraints);
  if (handler.get_triangulation().has_hanging_nodes())
    for (const auto& cell : handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (!cell->is_artificial() && cell->face(f)->has_children())
          ties.tie_hanging_nodes(cell, f);
  std::vector<Edge> seam_begin, seam_end;
  for (const auto& cell : space.outer_cells())
    for (const unsigned int f : {2U, 3U})
      if (cell->at_boundary(f))
        (f == 2 ? seam_begin : seam_end).push_back(edge_of(cell->face(f), degree));
  ties.tie_seam(std::move(seam_begin), std::move(seam_end), growth);
  constraints.close();
  return constraints;
}

} // namespace rollwave
