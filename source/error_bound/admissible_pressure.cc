#include "rollwave/error_bound/admissible_pressure.h"

#include "rollwave/contact/contact_problem.h"
#include "rollwave/mesh/contact_boundary.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace rollwave {

using namespace dealii;

namespace {

/// True if an edge lies wholly in the zone.
bool is_in_zone(const SurfaceFace& face, const Scene& scene) {
  return scene.is_in_zone(face.begin) && scene.is_in_zone(face.end);
}

/// Nodal force over the node's share of the edges that lie in the zone, for all surface nodes.
std::vector<double> nodal_pressures(const ContactBoundary& boundary, const Scene& scene,
                                    const ContactSolution& contact) {
  const RingSpace& space = boundary.space();
  const QGaussLobatto<1> lobatto(space.dof_handler().get_fe().degree + 1);
  std::vector<double> shares(space.surface_nodes().size()), pressures(shares.size());
  for (const SurfaceFace& face : space.surface_faces())
    if (is_in_zone(face, scene))
      for (unsigned int k = 0; k < face.nodes.size(); ++k)
        shares[face.nodes[k]] += lobatto.weight(k) * space.outer_radius() * (face.end - face.begin);
  for (unsigned int i = 0; i < shares.size(); ++i)
    if (const auto node = boundary.contact_number(i); node && shares[i] > 0)
      pressures[i] = std::max(0., contact.state.force(*node) / shares[i]);
  return pressures;
}

/// Moves forces off the edges beyond a vertex where contact ends: they would lie under a gap there.
/// They stay if the pressure, continued along a line from the edge in contact, does not end within
/// a third of the edge: the multiple of 1 - t nearest to 1 - t / t_0 is positive for t_0 > 1/3.
void move_into_contact(const std::vector<SurfaceFace>& faces, const std::vector<double>& pressures,
                       std::vector<EdgePressure>& edges) {
  const auto n_pressed = [&](unsigned int edge) {
    return std::count_if(faces[edge].nodes.begin(), faces[edge].nodes.end(),
                         [&](unsigned int node) { return pressures[node] > 0; });
  };
  const unsigned int degree = faces.front().nodes.size() - 1;
  const double first_node = QGaussLobatto<1>(degree + 1).point(1)[0];
  const auto move = [&](unsigned int from, unsigned int to, unsigned int vertex_of_to) {
    const bool is_in_zone = edges[to].mean > 0;
    if (n_pressed(from) != 1 || n_pressed(to) < 2 || !is_in_zone)
      return;
    const auto& nodes = faces[to].nodes;
    const double last = pressures[nodes[vertex_of_to]],
                 before = pressures[nodes[vertex_of_to == 0 ? 1 : degree - 1]];
    const double length = faces[from].end - faces[from].begin,
                 length_inside = faces[to].end - faces[to].begin;
    if (last * first_node * length_inside >= (before - last) * length / 3)
      return;
    edges[to].mean += edges[from].mean * length / length_inside;
    edges[from] = {0, 0};
  };
  for (unsigned int i = 0; i < faces.size(); ++i) {
    const unsigned int next = (i + 1) % faces.size();
    if (pressures[faces[next].nodes.front()] > 0) {
      move(i, next, 0);
      move(next, i, degree);
    }
  }
}

/// @throws ExcInternalError where the mean is negative
EdgePressure nonnegative_pressure(double mean, double slope) {
  AssertThrow(mean >= 0, ExcInternalError());
  return {mean, std::clamp(slope, -2 * mean, 2 * mean)};
}

} // namespace

std::vector<EdgePressure> admissible_pressures(const ContactBoundary& boundary, const Scene& scene,
                                               const ContactSolution& contact) {
  const RingSpace& space = boundary.space();
  const unsigned int degree = space.dof_handler().get_fe().degree;
  const QGaussLobatto<1> lobatto(degree + 1);
  const std::vector<double> pressures = nodal_pressures(boundary, scene, contact);
  std::vector<EdgePressure> edges;
  for (const SurfaceFace& face : space.surface_faces()) {
    edges.push_back({0, 0});
    if (!is_in_zone(face, scene))
      continue;
    for (unsigned int k = 0; k <= degree; ++k)
      edges.back().mean += lobatto.weight(k) * pressures[face.nodes[k]];
    if (degree > 1)
      edges.back().slope = pressures[face.nodes[degree]] - pressures[face.nodes[0]];
  }
  move_into_contact(space.surface_faces(), pressures, edges);
  for (EdgePressure& edge : edges)
    edge = nonnegative_pressure(edge.mean, edge.slope);
  return edges;
}

} // namespace rollwave
