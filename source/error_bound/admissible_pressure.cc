#include "rollwave/error_bound/admissible_pressure.h"

#include "rollwave/contact/contact_problem.h"
#include "rollwave/mesh/contact_boundary.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace rollwave {

using namespace dealii;

namespace {

/// True if an edge lies wholly in the zone.
bool is_in_zone(const SurfaceEdge& edge, const Scene& scene) {
  return scene.is_in_zone(edge.begin) && scene.is_in_zone(edge.end);
}

/// For all surface nodes: nodal force over the node's share of the edges that lie in the zone.
std::vector<double> nodal_pressures(const ContactBoundary& boundary, const Scene& scene,
                                    const ContactSolution& contact) {
  const RingSpace& space = boundary.space();
  const QGaussLobatto<1> lobatto(space.dof_handler().get_fe().degree + 1);
  std::vector<double> shares(space.surface_nodes().size()), pressures(shares.size());
  for (const SurfaceEdge& edge : space.surface_edges())
    if (is_in_zone(edge, scene))
      for (unsigned int k = 0; k < edge.nodes.size(); ++k)
        shares[edge.nodes[k]] += lobatto.weight(k) * space.outer_radius() * (edge.end - edge.begin);
  for (unsigned int i = 0; i < shares.size(); ++i)
    if (const auto node = boundary.contact_number(i); node && shares[i] > 0)
      pressures[i] = std::max(0., contact.state.force(*node) / shares[i]);
  return pressures;
}

/// Moves forces off an edge beyond the vertex where contact ends, since they would lie under a gap
/// there. They stay if the pressure, continued along a line from the edge in contact, does not end
/// within a third of the edge: the multiple of 1 - t nearest to 1 - t / t_0 is positive for
/// t_0 > 1/3.
void move_into_contact(const std::vector<SurfaceEdge>& edges, const std::vector<double>& pressures,
                       std::vector<EdgePressure>& edge_pressures) {
  const auto n_pressed = [&](unsigned int edge) {
    return std::count_if(edges[edge].nodes.begin(), edges[edge].nodes.end(),
                         [&](unsigned int node) { return pressures[node] > 0; });
  };
  const unsigned int degree = edges.front().nodes.size() - 1;
  const double first_node = QGaussLobatto<1>(degree + 1).point(1)[0];
  const auto move = [&](unsigned int from, unsigned int to, unsigned int vertex_of_to) {
    // Edges outside of the zone have no pressure.
    if (n_pressed(from) != 1 || n_pressed(to) < 2 || edge_pressures[to].mean == 0)
      return;
    const auto& nodes = edges[to].nodes;
    const double last = pressures[nodes[vertex_of_to]],
                 before = pressures[nodes[vertex_of_to == 0 ? 1 : degree - 1]];
    const double length = edges[from].end - edges[from].begin,
                 length_inside = edges[to].end - edges[to].begin;
    if (last * first_node * length_inside >= (before - last) * length / 3)
      return;
    edge_pressures[to].mean += edge_pressures[from].mean * length / length_inside;
    edge_pressures[from] = {0, 0};
  };
  for (unsigned int i = 0; i < edges.size(); ++i) {
    const unsigned int next = (i + 1) % edges.size();
    if (pressures[edges[next].nodes.front()] > 0) {
      move(i, next, 0);
      move(next, i, degree);
    }
  }
}

} // namespace

std::vector<EdgePressure> admissible_pressures(const ContactBoundary& boundary, const Scene& scene,
                                               const ContactSolution& contact) {
  const RingSpace& space = boundary.space();
  const unsigned int degree = space.dof_handler().get_fe().degree;
  const QGaussLobatto<1> lobatto(degree + 1);
  const std::vector<double> pressures = nodal_pressures(boundary, scene, contact);
  std::vector<EdgePressure> edge_pressures;
  for (const SurfaceEdge& edge : space.surface_edges()) {
    edge_pressures.push_back({0, 0});
    if (!is_in_zone(edge, scene))
      continue;
    for (unsigned int k = 0; k <= degree; ++k)
      edge_pressures.back().mean += lobatto.weight(k) * pressures[edge.nodes[k]];
    if (degree > 1)
      edge_pressures.back().slope = pressures[edge.nodes[degree]] - pressures[edge.nodes[0]];
  }
  move_into_contact(space.surface_edges(), pressures, edge_pressures);
  // The means are sums of pressures >= 0. The limits of the slope keep lambda >= 0 at both
  // vertices.
  for (EdgePressure& edge : edge_pressures)
    edge.slope = std::clamp(edge.slope, -2 * edge.mean, 2 * edge.mean);
  return edge_pressures;
}

} // namespace rollwave
