#include "rollwave/mesh/ring_space.h"

#include "rollwave/mesh/nested_dissection.h"
#include "rollwave/mesh/ring_mesh.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/numerics/vector_tools_boundary.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace rollwave {

using namespace dealii;

namespace {

/// A node of an edge on r = b.
struct EdgeNode {
  double begin; ///< angle at which the edge begins
  double angle, weight, cell_ratio;
  types::global_dof_index dof;

  template <class Archive>
  void serialize(Archive& archive, unsigned int) {
    archive& begin& angle& weight& cell_ratio& dof;
  }
};

/// The nodes of all edges of all processes, edge by edge from the seam on.
std::vector<EdgeNode> gather_edges(const RingSpace& space) {
  const unsigned int p = space.dof_handler().get_fe().degree;
  const QGaussLobatto<1> rule(p + 1);
  LexicographicDofs dofs(space.dof_handler());
  std::vector<EdgeNode> own, all;
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned() || !cell->at_boundary(1))
      continue;
    const double begin = cell->vertex(1)[1], length = cell->vertex(3)[1] - begin;
    const double cell_ratio =
        (cell->vertex(1)[0] - cell->vertex(0)[0]) / (space.outer_radius() * length);
    for (unsigned int k = 0; k <= p; ++k) {
      // A node on the seam counts as the node that its constraint equates it with.
      const auto dof = dofs.of(cell)[p + (p + 1) * k];
      const auto* const entries = space.constraints().get_constraint_entries(dof);
      own.push_back({begin, begin + length * rule.point(k)[0],
                     space.outer_radius() * length * rule.weight(k), cell_ratio,
                     entries ? entries->front().first : dof});
    }
  }
  for (const auto& some : Utilities::MPI::all_gather(space.communicator(), own))
    all.insert(all.end(), some.begin(), some.end());
  std::stable_sort(all.begin(), all.end(), [](const EdgeNode& left, const EdgeNode& right) {
    return left.begin < right.begin;
  });
  return all;
}

} // namespace

RingSpace::RingSpace(const Triangulation<2>& triangulation, const Scene& scene, unsigned int degree)
    : radius(scene.outer_radius), element(degree), handler(triangulation) {
  handler.distribute_dofs(element);

  relevant = DoFTools::extract_locally_relevant_dofs(handler);
  affine_constraints = AffineConstraints<double>(relevant);
  // Hanging nodes first, the period after them: the other order would constrain hanging nodes on
  // the seam twice.
  if (triangulation.has_hanging_nodes())
    DoFTools::make_hanging_node_constraints(handler, affine_constraints);
  DoFTools::make_periodicity_constraints(handler, seam_begin_id, seam_end_id, /*direction=*/1,
                                         affine_constraints);
  VectorTools::interpolate_boundary_values(cartesian, handler, hub_id, Functions::ZeroFunction<2>(),
                                           affine_constraints);
  affine_constraints.close();
  const IndexSet& owned = handler.locally_owned_dofs();
  unsigned int n_own_unknowns = 0;
  for (const auto dof : owned)
    n_own_unknowns += !affine_constraints.is_constrained(dof);
  unknowns = Utilities::MPI::sum(n_own_unknowns, communicator());

  order = dissect(handler);
  for (const auto& line : affine_constraints.get_lines())
    for (const auto& entry : line.entries)
      relevant.add_index(entry.first);
  partitioner = std::make_shared<Utilities::MPI::Partitioner>(owned, relevant, communicator());
  find_surface(scene);
}

std::pair<double, double> RingSpace::diameters() const {
  double least = std::numeric_limits<double>::max(), largest = 0;
  for (const auto& cell : handler.active_cell_iterators())
    if (cell->is_locally_owned()) {
      const Tensor<1, 2> size = cell->vertex(3) - cell->vertex(0);
      const double diameter = std::hypot(size[0], radius * size[1]);
      least = std::min(least, diameter);
      largest = std::max(largest, diameter);
    }
  return {Utilities::MPI::min(least, communicator()), Utilities::MPI::max(largest, communicator())};
}

void RingSpace::find_surface(const Scene& scene) {
  const double middle = (scene.zone_begin + scene.zone_end) / 2;
  const auto turn = [middle](double z) {
    return 2 * numbers::PI * std::floor((z - middle) / (2 * numbers::PI) + 0.5);
  };
  const std::vector<EdgeNode> edges = gather_edges(*this);
  std::map<types::global_dof_index, SurfaceNode> nodes;
  for (const auto& [begin, z, weight, cell_ratio, dof] : edges) {
    SurfaceNode& node = nodes.emplace(dof, SurfaceNode{dof, z - turn(z), 0.}).first->second;
    node.weight += weight;
    node.cell_ratio = std::max(node.cell_ratio, cell_ratio);
  }
  for (const auto& [dof, node] : nodes)
    surface.push_back(node);
  std::sort(surface.begin(), surface.end(),
            [](const auto& left, const auto& right) { return left.angle < right.angle; });
  std::map<types::global_dof_index, unsigned int> number_of_dof;
  for (unsigned int i = 0; i < surface.size(); ++i)
    number_of_dof[surface[i].dof] = i;

  for (unsigned int first = 0; first < edges.size(); first += element.degree + 1) {
    const double begin = edges[first].angle, end = edges[first + element.degree].angle,
                 turned = turn((begin + end) / 2);
    edge_from[edges[first].begin] = edges_of_surface.size();
    edges_of_surface.push_back({begin - turned, end - turned, {}});
    for (unsigned int k = 0; k <= element.degree; ++k)
      edges_of_surface.back().nodes.push_back(number_of_dof.at(edges[first + k].dof));
  }
}

std::optional<unsigned int>
RingSpace::surface_edge(const Triangulation<2>::active_cell_iterator& cell) const {
  if (cell->vertex(1)[0] != radius) // quicker than at_boundary(), and asked for every cell
    return {};
  return edge_from.at(cell->vertex(1)[1]);
}

std::vector<double> RingSpace::surface_values(const FieldVector& field) const {
  // A sum with zeros is exact in any order, so that all processes get the same digits.
  std::vector<double> values(surface.size());
  for (unsigned int i = 0; i < surface.size(); ++i)
    if (field.in_local_range(surface[i].dof))
      values[i] = field(surface[i].dof);
  Utilities::MPI::sum(values, communicator(), values);
  return values;
}

std::vector<DoFHandler<2>::active_cell_iterator>
neighbours(const DoFHandler<2>::active_cell_iterator& cell, unsigned int face) {
  const bool is_at_seam = cell->at_boundary(face);
  if (is_at_seam && !cell->has_periodic_neighbor(face))
    return {};
  if (!cell->neighbor_or_periodic_neighbor(face)->has_children())
    return {cell->neighbor_or_periodic_neighbor(face)};
  const auto child = [&](unsigned int number) -> DoFHandler<2>::active_cell_iterator {
    return is_at_seam ? cell->periodic_neighbor_child_on_subface(face, number)
                      : cell->neighbor_child_on_subface(face, number);
  };
  return {child(0), child(1)};
}

} // namespace rollwave
