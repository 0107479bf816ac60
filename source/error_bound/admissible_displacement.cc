#include "rollwave/error_bound/admissible_displacement.h"

#include "rollwave/mesh/line_elements.h"
#include "rollwave/scene/scene.h"

#include <boost/math/tools/roots.hpp>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

FieldVector project_contact_nodes(const RingSpace& space, const ContactProblem& problem,
                                  const std::vector<bool>& active, FieldVector field) {
  for (unsigned int i = 0; i < problem.size(); ++i) {
    const auto dof = space.contact_nodes()[i].dof;
    if (field.in_local_range(dof))
      field(dof) = active[i] ? problem.road(i) : std::min(field(dof), problem.road(i));
  }
  space.constraints().distribute(field);
  field.update_ghost_values();
  return field;
}

namespace {

/// The zero of @p function between two places where it has different signs.
template <typename Function>
double root(const Function& function, double left, double right, double at_left, double at_right) {
  std::uintmax_t most_evaluations = 60;
  const auto bracket = boost::math::tools::toms748_solve(
      function, left, right, at_left, at_right, boost::math::tools::eps_tolerance<double>(40),
      most_evaluations);
  return (bracket.first + bracket.second) / 2;
}

} // namespace

AdmissibleTrace::AdmissibleTrace(const RingSpace& space, const Scene& scene,
                                 const FieldVector& field, const std::vector<bool>& active)
    : phi(scene.phi), shapes(lobatto_lagrange(space.dof_handler().get_fe().degree)) {
  const std::vector<double> values = space.surface_values(field);
  for (const SurfaceFace& face : space.surface_faces()) {
    Edge edge{face.begin, face.end, {}, {}};
    unsigned int n_active = 0;
    for (const unsigned int node : face.nodes) {
      edge.nodal_values.push_back(values[node]);
      const auto contact = space.contact_number(node);
      n_active += contact && active[*contact];
    }
    // The part of the edge in the zone, in terms of t.
    const double length = edge.end - edge.begin;
    const bool begins_before = scene.zone_begin - edge.begin <= Scene::angular_round_off;
    const bool ends_behind = edge.end - scene.zone_end <= Scene::angular_round_off;
    const double zone_begin = begins_before ? 0 : (scene.zone_begin - edge.begin) / length;
    const double zone_end = ends_behind ? 1 : (scene.zone_end - edge.begin) / length;
    if (n_active == face.nodes.size() && zone_begin == 0 && zone_end == 1)
      edge.pieces = {{Piece::Kind::touching, 0, 1}};
    else if (zone_begin < zone_end)
      find_pieces(edge, zone_begin, zone_end);
    else
      edge.pieces = {{Piece::Kind::outside, 0, 1}};
    edges.push_back(std::move(edge));
  }
}

void AdmissibleTrace::find_pieces(Edge& edge, double zone_begin, double zone_end) const {
  const auto excess_at = [&](double t) { return excess(edge, t).value; };
  const auto slope_at = [&](double t) { return excess(edge, t).slope; };
  std::vector<double> ends = {zone_begin};
  const auto split = [&](double left, double right, double at_left, double at_right) {
    if (at_left * at_right < 0)
      ends.push_back(root(excess_at, left, right, at_left, at_right));
  };
  const QGaussLobatto<1> nodes(shapes.size());
  static const QGaussLobatto<1> samples(8);
  for (unsigned int k = 0; k + 1 < nodes.size(); ++k) {
    const double low = std::max(zone_begin, nodes.point(k)[0]);
    const double high = std::min(zone_end, nodes.point(k + 1)[0]);
    if (!(low < high))
      continue;
    for (unsigned int i = 0; i + 1 < samples.size(); ++i) {
      const double left = low + (high - low) * samples.point(i)[0];
      const double right = low + (high - low) * samples.point(i + 1)[0];
      const double at_left = excess_at(left), at_right = excess_at(right);
      const double rise_left = slope_at(left), rise_right = slope_at(right);
      // Between samples the excess may have its only positive stretch, however short, and at
      // active nodes it vanishes: an extremum parts what a comparison of signs would miss.
      if (rise_left * rise_right < 0) {
        const double extremum = root(slope_at, left, right, rise_left, rise_right);
        const double at_extremum = excess_at(extremum);
        split(left, extremum, at_left, at_extremum);
        split(extremum, right, at_extremum, at_right);
      } else
        split(left, right, at_left, at_right);
    }
    ends.push_back(high);
  }

  if (zone_begin > 0)
    edge.pieces.push_back(
        {Piece::Kind::outside, 0, zone_begin, 0, -std::max(0., excess_at(zone_begin))});
  for (unsigned int i = 0; i + 1 < ends.size(); ++i)
    edge.pieces.push_back({Piece::Kind::limited, ends[i], ends[i + 1]});
  if (zone_end < 1)
    edge.pieces.push_back(
        {Piece::Kind::outside, zone_end, 1, -std::max(0., excess_at(zone_end)), 0});
}

AdmissibleTrace::ValueAndSlope AdmissibleTrace::excess(const Edge& edge, double t) const {
  const double length = edge.end - edge.begin, z = edge.begin + t * length;
  ValueAndSlope excess = {-phi(z), -phi.slope(z)};
  double both[2];
  for (unsigned int i = 0; i < shapes.size(); ++i) {
    shapes[i].value(t, 1, both);
    excess.value += edge.nodal_values[i] * both[0];
    excess.slope += edge.nodal_values[i] * both[1] / length;
  }
  return excess;
}

AdmissibleTrace::Correction AdmissibleTrace::correction(unsigned int face, const Piece& piece,
                                                        double t) const {
  const Edge& edge = edges[face];
  if (piece.kind == Piece::Kind::outside) {
    const double slope = (piece.value_end - piece.value_begin) / (piece.t_end - piece.t_begin);
    return {piece.value_begin + slope * (t - piece.t_begin), slope / (edge.end - edge.begin), 0};
  }
  const auto [above, slope] = excess(edge, t);
  if (piece.kind == Piece::Kind::limited && above <= 0)
    return {0, 0, -above};
  return {-above, -slope, 0};
}

double AdmissibleTrace::displacement(unsigned int face, const Piece& piece, double t) const {
  double discrete = 0;
  for (unsigned int i = 0; i < shapes.size(); ++i)
    discrete += edges[face].nodal_values[i] * shapes[i].value(t);
  return discrete + correction(face, piece, t).value;
}

} // namespace rollwave
