#include "rollwave/error_bound/dual_system.h"

#include "rollwave/base/run_statistics.h"
#include "rollwave/error_bound/dual_cell_matrix.h"
#include "rollwave/mesh/line_elements.h"
#include "rollwave/scene/scene.h"
#include "rollwave/solver/system_matrix.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe.h>
#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

using Dof = types::global_dof_index;
using Cell = DoFHandler<2>::active_cell_iterator;

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

/// Gives psi on r = b, the primitive of b lambda, zero where the seam begins; returns by how much
/// it grows in a period.
double fix_surface(const RingSpace& space, const std::vector<EdgePressure>& pressures,
                   AffineConstraints<double>& constraints) {
  const unsigned int degree = space.dof_handler().get_fe().degree;
  const QGaussLobatto<1> nodes(degree + 1);
  const auto area = [&](unsigned int edge) {
    return space.outer_radius() *
           (space.surface_edges()[edge].end - space.surface_edges()[edge].begin);
  };
  std::vector<double> at_begin = {0}; // of each edge
  for (unsigned int edge = 0; edge < pressures.size(); ++edge)
    at_begin.push_back(at_begin.back() + area(edge) * pressures[edge].mean);
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (cell->is_artificial() || !cell->at_boundary(1))
      continue;
    const unsigned int edge = *space.surface_edge(cell);
    const auto& [mean, slope] = pressures[edge];
    // Not SurfaceEdge::nodes, in which both sides of the seam are one.
    const std::vector<Dof> dofs = edge_of(cell->face(1), degree).dofs;
    for (unsigned int k = 0; k <= degree; ++k) {
      const double t = nodes.point(k)[0];
      constraints.add_line(dofs[k]);
      constraints.set_inhomogeneity(dofs[k],
                                    at_begin[edge] + area(edge) * t * (mean - slope * (1 - t) / 2));
    }
  }
  return at_begin.back();
}

/// Makes psi continuous over hanging nodes and, except for its growth in a period, over the seam.
/// Nodes on the finer side of an edge follow those of the coarser side by the shapes of
/// StressFunctionBasis, deal.II's own constraints being for polynomials only.
class ContinuityConstraints {
public:
  ContinuityConstraints(const Scene& scene, unsigned int degree, double growth,
                        AffineConstraints<double>& constraints)
      : scene(scene), degree(degree), growth(growth), polynomials(lobatto_lagrange(degree)),
        nodes(QGaussLobatto<1>(degree + 1).get_points()), constraints(constraints) {}

  /// Ties nodes of the cells beyond the face @p f of a cell to those on it.
  void tie_face(const Cell& cell, unsigned int f) {
    const auto beyond = neighbours(cell, f);
    for (unsigned int half = 0; half < beyond.size(); ++half) {
      const bool is_finer = beyond[half]->level() > cell->level(),
                 is_over_seam = f == 2 && cell->at_boundary(f);
      // Beyond the cells next to its own a process knows no degrees of freedom.
      if (beyond[half]->is_artificial() || beyond[half]->level() < cell->level() ||
          !(is_finer || is_over_seam))
        continue;
      const Edge coarse = edge_of(cell->face(f), degree),
                 fine = edge_of(beyond[half]->face(f ^ 1U), degree);
      if (f < 2)
        tie_along_z(fine, coarse, half);
      else
        tie_along_r(fine, coarse, f, cell->at_boundary(f));
    }
  }

private:
  void tie_along_z(const Edge& fine, const Edge& coarse, unsigned int half) {
    Vector<double> weights(degree + 1);
    for (unsigned int k = 0; k <= degree; ++k) {
      for (unsigned int j = 0; j <= degree; ++j)
        weights[j] = polynomials[j].value((half + nodes[k][0]) / 2);
      if (k != degree * half) // the vertex of both
        tie(fine.dofs[k], coarse.dofs, weights, 0);
    }
  }

  void tie_along_r(const Edge& fine, const Edge& coarse, unsigned int f, bool is_seam) {
    const double begin = coarse.begin, end = coarse.end;
    const StressFunctionBasis& basis =
        bases.try_emplace({begin, end}, scene, degree, begin, end).first->second;
    Vector<double> unity(1);
    unity = 1;
    for (unsigned int k = 0; k <= degree; ++k) {
      const double r = k == degree ? fine.end : fine.begin + nodes[k][0] * (fine.end - fine.begin);
      if (r != begin && r != end)
        tie(fine.dofs[k], coarse.dofs, basis.values(r), !is_seam ? 0 : f == 2 ? growth : -growth);
      else if (is_seam) {
        // Of two vertices the one where the seam ends follows, whichever side is finer.
        const Dof vertex = r == begin ? coarse.dofs.front() : coarse.dofs.back();
        tie(f == 2 ? fine.dofs[k] : vertex, {f == 2 ? vertex : fine.dofs[k]}, unity, growth);
      }
    }
  }

  void tie(Dof dof, const std::vector<Dof>& masters, const Vector<double>& weights, double offset) {
    if (constraints.is_constrained(dof))
      return;
    constraints.add_line(dof);
    constraints.set_inhomogeneity(dof, offset);
    for (unsigned int j = 0; j < masters.size(); ++j)
      // A node that is one of the masters depends on the others only by round-off.
      if (std::abs(weights[j]) > 1e-13)
        constraints.add_entry(dof, masters[j], weights[j]);
  }

  const Scene& scene;
  const unsigned int degree;
  const double growth;
  const std::vector<Polynomials::Polynomial<double>> polynomials;
  const std::vector<Point<1>> nodes;
  AffineConstraints<double>& constraints;
  std::map<std::pair<double, double>, StressFunctionBasis> bases; ///< of radial edges
};

/// The constraints of the nodal values of psi: its trace on r = b, continuity and the period.
/// @param pressures for degree 1 with zero slopes
AffineConstraints<double> make_constraints(const RingSpace& space, const Scene& scene,
                                           const std::vector<EdgePressure>& pressures) {
  const DoFHandler<2>& handler = space.dof_handler();
  const unsigned int degree = handler.get_fe().degree;
  AffineConstraints<double> constraints(space.relevant_dofs());
  const double growth = fix_surface(space, pressures, constraints);
  ContinuityConstraints continuity(scene, degree, growth, constraints);
  for (const auto& cell : handler.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (!cell->is_artificial() && (cell->face(f)->has_children() || cell->at_boundary(f)))
        continuity.tie_face(cell, f);
  constraints.close();
  return constraints;
}

} // namespace

DualSystem::DualSystem(const RingSpace& space, const RadialShapesOfMesh& shapes, const Scene& scene,
                       RunStatistics& statistics)
    : space(space), radial(shapes) {
  const std::vector<EdgePressure> no_pressures(space.surface_edges().size());
  const auto constraints = make_constraints(space, scene, no_pressures);
  SystemMatrix matrix(space, constraints);
  DualCellMatrix cell_matrix(radial, space.dof_handler().get_fe().degree);
  LexicographicDofs dofs(space.dof_handler());
  for (const auto& cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
      matrix.add(dofs.of(cell), cell_matrix.on(cell));
  factor = matrix.factorise(statistics);
  condensed = std::make_unique<CondensedSystem>(*factor, space.communicator());
}

FieldVector DualSystem::stress_function(const Scene& scene,
                                        const std::vector<EdgePressure>& pressures,
                                        const ForceIntegral* force,
                                        RunStatistics& statistics) const {
  const auto constraints = make_constraints(space, scene, pressures);
  const auto is_given = [&](auto dof) { return constraints.is_inhomogeneously_constrained(dof); };
  const Vector<double> no_load(space.dof_handler().get_fe().n_dofs_per_cell());
  DualCellMatrix cell_matrix(radial, space.dof_handler().get_fe().degree);
  LexicographicDofs dofs_of_cells(space.dof_handler());
  FieldVector load = space.make_field();
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const auto& dofs = dofs_of_cells.of(cell);
    if (std::any_of(dofs.begin(), dofs.end(), is_given))
      constraints.distribute_local_to_global(no_load, dofs, load, cell_matrix.on(cell));
  }
  if (force && !force->is_uniform()) // a function of r does no work on periodic stress functions
    force->add_load(space, radial, ForceIntegral::TestSpace::stress_functions, constraints, load);
  load.compress(VectorOperation::add);
  Vector<double> kept(condensed->kept().size());
  condensed->solve(std::vector<bool>(kept.size(), false), factor->condense(load, statistics), kept);
  FieldVector psi = factor->expand(&load, kept, statistics);
  constraints.distribute(psi);
  psi.update_ghost_values();
  return psi;
}

} // namespace rollwave
