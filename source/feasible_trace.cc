#include "feasible_trace.h"

#include "scene.h"
#include "shape_products.h"

#include <boost/math/tools/roots.hpp>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace rollwave {

using namespace dealii;

FieldVector project_contact_nodes(const RingSpace& space, const ContactProblem& problem,
                                  const std::vector<bool>& active, FieldVector field) {
  for (unsigned int i = 0; i < problem.size(); ++i) {
    double& u = field(space.contact_nodes()[i].dof);
    u = active[i] ? problem.road(i) : std::min(u, problem.road(i));
  }
  space.constraints().distribute(field);
  return field;
}

FeasibleTrace::FeasibleTrace(const RingSpace& space, const Scene& scene, const FieldVector& field,
                             const std::vector<bool>& active)
    : road(scene.road), road_slope(scene.road_slope),
      shapes(lobatto_lagrange(space.dof_handler().get_fe().degree)) {
  std::map<types::global_dof_index, bool> is_active;
  for (unsigned int i = 0; i < active.size(); ++i)
    is_active[space.contact_nodes()[i].dof] = active[i];

  for (const SurfaceFace& face : space.surface_faces()) {
    Edge edge{face.begin, face.end, {}, {}};
    unsigned int n_active = 0;
    for (const auto dof : face.dofs) {
      edge.nodal_values.push_back(field(dof));
      const auto found = is_active.find(dof);
      n_active += found != is_active.end() && found->second;
    }
    // The part of the edge in the zone, in terms of t. A zone that ends within round-off of a
    // vertex ends there.
    const double length = edge.end - edge.begin, tolerance = 1e-12 / length;
    double zone_begin = (scene.zone_begin - edge.begin) / length;
    double zone_end = (scene.zone_end - edge.begin) / length;
    zone_begin = zone_begin < tolerance ? 0 : zone_begin;
    zone_end = zone_end > 1 - tolerance ? 1 : zone_end;
    if (n_active == face.dofs.size() && zone_begin == 0 && zone_end == 1)
      edge.pieces = {{Piece::Kind::touching, 0, 1}};
    else if (zone_begin < zone_end)
      find_pieces(edge, zone_begin, zone_end);
    else
      edge.pieces = {{Piece::Kind::free, 0, 1}};
    edges.push_back(std::move(edge));
  }
}

void FeasibleTrace::find_pieces(Edge& edge, double zone_begin, double zone_end) const {
  const auto excess_at = [&](double t) { return excess(edge, t); };
  // u_h - phi vanishes at active nodes: what lies between them is looked at from inside.
  std::vector<double> ends = {zone_begin};
  const QGaussLobatto<1> nodes(shapes.size());
  const QGaussLobatto<1> samples(8);
  for (unsigned int k = 0; k + 1 < nodes.size(); ++k) {
    const double low = std::max(zone_begin, nodes.point(k)[0]);
    const double high = std::min(zone_end, nodes.point(k + 1)[0]);
    if (!(low < high))
      continue;
    for (unsigned int i = 1; i + 2 < samples.size(); ++i) {
      const double left = low + (high - low) * samples.point(i)[0];
      const double right = low + (high - low) * samples.point(i + 1)[0];
      const double at_left = excess_at(left), at_right = excess_at(right);
      if (at_left * at_right < 0) {
        std::uintmax_t most_evaluations = 60;
        const auto root = boost::math::tools::toms748_solve(
            excess_at, left, right, at_left, at_right,
            boost::math::tools::eps_tolerance<double>(40), most_evaluations);
        ends.push_back((root.first + root.second) / 2);
      }
    }
    ends.push_back(high);
  }

  if (zone_begin > 0)
    edge.pieces.push_back(
        {Piece::Kind::ramp, 0, zone_begin, 0, -std::max(0., excess_at(zone_begin))});
  for (unsigned int i = 0; i + 1 < ends.size(); ++i)
    edge.pieces.push_back({Piece::Kind::limited, ends[i], ends[i + 1]});
  if (zone_end < 1)
    edge.pieces.push_back({Piece::Kind::ramp, zone_end, 1, -std::max(0., excess_at(zone_end)), 0});
}

double FeasibleTrace::discrete(const Edge& edge, double t) const {
  double sum = 0;
  for (unsigned int i = 0; i < shapes.size(); ++i)
    sum += edge.nodal_values[i] * shapes[i].value(t);
  return sum;
}

double FeasibleTrace::discrete_slope(const Edge& edge, double t) const {
  double sum = 0;
  std::vector<double> both(2);
  for (unsigned int i = 0; i < shapes.size(); ++i) {
    shapes[i].value(t, both);
    sum += edge.nodal_values[i] * both[1];
  }
  return sum / (edge.end - edge.begin);
}

double FeasibleTrace::excess(const Edge& edge, double t) const {
  return discrete(edge, t) - road(edge.begin + t * (edge.end - edge.begin));
}

FeasibleTrace::Correction FeasibleTrace::correction(unsigned int face, const Piece& piece,
                                                    double t) const {
  const Edge& edge = edges[face];
  const double length = edge.end - edge.begin;
  switch (piece.kind) {
  case Piece::Kind::free:
    break;
  case Piece::Kind::limited:
    if (const double here = excess(edge, t); here <= 0)
      return {0, 0, -here};
    [[fallthrough]];
  case Piece::Kind::touching:
    return {-excess(edge, t), road_slope(edge.begin + t * length) - discrete_slope(edge, t), 0};
  case Piece::Kind::ramp: {
    const double slope = (piece.value_end - piece.value_begin) / (piece.t_end - piece.t_begin);
    return {piece.value_begin + slope * (t - piece.t_begin), slope / length, 0};
  }
  }
  return {0, 0, 0};
}

double FeasibleTrace::displacement(unsigned int face, const Piece& piece, double t) const {
  return discrete(edges[face], t) + correction(face, piece, t).value;
}

} // namespace rollwave
