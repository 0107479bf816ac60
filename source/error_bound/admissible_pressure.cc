#include "rollwave/error_bound/admissible_pressure.h"

#include "rollwave/contact/contact_problem.h"
#include "rollwave/mesh/ring_space.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace rollwave {

using namespace dealii;

namespace {

/// Whether an edge lies wholly in the zone.
bool is_in_zone(const SurfaceFace& face, const Scene& scene) {
  return scene.is_in_zone(face.begin) && scene.is_in_zone(face.end);
}

/// Nodal force over the node's share of the edges that lie in the zone, for all surface nodes.
std::vector<double> nodal_pressures(const RingSpace& space, const Scene& scene,
                                    const ContactSolution& contact) {
  const QGaussLobatto<1> lobatto(space.dof_handler().get_fe().degree + 1);
  std::vector<double> shares(space.surface_nodes().size()), pressures(shares.size());
  for (const SurfaceFace& face : space.surface_faces())
    if (is_in_zone(face, scene))
      for (unsigned int k = 0; k < face.nodes.size(); ++k)
        shares[face.nodes[k]] += lobatto.weight(k) * space.outer_radius() * (face.end - face.begin);
  for (unsigned int i = 0; i < shares.size(); ++i)
    if (const auto node = space.contact_number(i); node && shares[i] > 0)
      pressures[i] = std::max(0., contact.state.force(*node) / shares[i]);
  return pressures;
}

/// The power of t, on the edge where contact ends, that pressures of a degree take.
unsigned int end_power(unsigned int degree) {
  return degree == 1 ? 0 : degree == 2 ? 2 : 1;
}

/// The mean of the multiple of (1 - t)^q that is nearest to value (1 - t / root).
double mean_beyond(double value, double root, unsigned int q) {
  return value * (1 - 1 / (root * (q + 2))) * (2. * q + 1) / ((q + 1.) * (q + 1.));
}

} // namespace

std::vector<EdgePressure> admissible_pressures(const RingSpace& space, const Scene& scene,
                                               const ContactSolution& contact) {
  const unsigned int degree = space.dof_handler().get_fe().degree, q = end_power(degree);
  const QGaussLobatto<1> lobatto(degree + 1);
  const std::vector<double> pressures = nodal_pressures(space, scene, contact);
  const auto pressure = [&](const SurfaceFace& face, unsigned int k) {
    return pressures[face.nodes[k]];
  };
  const std::vector<SurfaceFace>& faces = space.surface_faces();

  std::vector<EdgePressure> edges;
  for (const SurfaceFace& face : faces) {
    if (!is_in_zone(face, scene)) {
      edges.push_back({0, 0});
      continue;
    }
    double mean = 0;
    for (unsigned int k = 0; k <= degree; ++k)
      mean += lobatto.weight(k) * pressure(face, k);
    edges.push_back({mean, degree > 1 ? pressure(face, degree) - pressure(face, 0) : 0.});
  }

  const auto shift = [&](unsigned int outside, unsigned int inside, bool contact_lies_before) {
    const SurfaceFace &out = faces[outside], &in = faces[inside];
    const unsigned int end = contact_lies_before ? 0 : degree;
    const auto n_pressed = std::count_if(out.nodes.begin(), out.nodes.end(),
                                         [&](unsigned int node) { return pressures[node] > 0; });
    if (!(edges[outside].mean > 0) || !(edges[inside].mean > 0) || n_pressed > 1 ||
        pressure(out, end) == 0)
      return;
    const double last = pressure(out, end);
    const double before = pressure(in, contact_lies_before ? degree - 1 : 1);
    if (before <= last)
      return;
    const double length = out.end - out.begin, length_inside = in.end - in.begin;
    const double root = lobatto.point(1)[0] * length_inside * last / (before - last) / length;
    const double moved =
        edges[outside].mean - std::clamp(mean_beyond(last, root, q), 0., edges[outside].mean);
    edges[outside].mean -= moved;
    edges[inside].mean += moved * length / length_inside;
  };
  for (unsigned int i = 0; i < edges.size(); ++i) {
    const unsigned int next = (i + 1) % edges.size();
    shift(next, i, true);
    shift(i, next, false);
  }
  for (EdgePressure& edge : edges) {
    const double limit = degree > 1 ? (q + 1) * edge.mean : 0;
    edge.slope = std::clamp(edge.slope, -limit, limit);
  }
  return edges;
}

} // namespace rollwave
