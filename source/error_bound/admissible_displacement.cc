#include "rollwave/error_bound/admissible_displacement.h"

#include "rollwave/scene/scene.h"

#include <boost/math/tools/roots.hpp>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace rollwave {

using namespace dealii;

FieldVector project_contact_nodes(const ContactBoundary& boundary, const ContactProblem& problem,
                                  const std::vector<bool>& active, FieldVector field) {
  for (unsigned int i = 0; i < problem.size(); ++i) {
    const auto dof = boundary.contact_nodes()[i].dof;
    if (field.in_local_range(dof))
      field(dof) = active[i] ? problem.phi(i) : std::min(field(dof), problem.phi(i));
  }
  boundary.space().constraints().distribute(field);
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

AdmissibleTrace::AdmissibleTrace(const ContactBoundary& boundary, const Scene& scene,
                                 const FieldVector& field, const std::vector<bool>& active)
    : phi(scene.phi), discrete(boundary.space(), field) {
  const auto is_active = [&](unsigned int node) {
    const auto contact = boundary.contact_number(node);
    return contact && active[*contact];
  };
  for (unsigned int edge = 0; edge < discrete.edges().size(); ++edge) {
    const auto& nodes = discrete.edges()[edge].nodes;
    edges.push_back(
        pieces_of(edge, scene.zone(), std::all_of(nodes.begin(), nodes.end(), is_active)));
  }
}

/// @param touches true if all nodes of the edge are in contact
std::vector<AdmissibleTrace::Piece>
AdmissibleTrace::pieces_of(unsigned int edge, const std::pair<double, double>& zone,
                           bool touches) const {
  // The part of the edge in the zone, in terms of t.
  const auto& [begin, end, nodes] = discrete.edges()[edge];
  const double length = end - begin;
  const bool begins_before = zone.first - begin <= angular_round_off;
  const bool ends_after = end - zone.second <= angular_round_off;
  const double zone_begin = begins_before ? 0 : (zone.first - begin) / length;
  const double zone_end = ends_after ? 1 : (zone.second - begin) / length;
  if (touches && zone_begin == 0 && zone_end == 1)
    return {{Piece::Kind::touching, 0, 1}};
  if (zone_begin < zone_end)
    return limited_pieces(edge, zone_begin, zone_end);
  return {{Piece::Kind::outside, 0, 1}};
}

std::vector<AdmissibleTrace::Piece>
AdmissibleTrace::limited_pieces(unsigned int edge, double zone_begin, double zone_end) const {
  const auto excess_at = [&](double t) { return excess(edge, t).value; };
  const auto slope_at = [&](double t) { return excess(edge, t).slope; };
  std::vector<double> ends = {zone_begin};
  const auto split = [&](double left, double right, double at_left, double at_right) {
    if (at_left * at_right < 0)
      ends.push_back(root(excess_at, left, right, at_left, at_right));
  };
  const QGaussLobatto<1> nodes(discrete.edges()[edge].nodes.size());
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

  std::vector<Piece> pieces;
  if (zone_begin > 0)
    pieces.push_back(
        {Piece::Kind::outside, 0, zone_begin, 0, -std::max(0., excess_at(zone_begin))});
  for (unsigned int i = 0; i + 1 < ends.size(); ++i)
    pieces.push_back({Piece::Kind::limited, ends[i], ends[i + 1]});
  if (zone_end < 1)
    pieces.push_back({Piece::Kind::outside, zone_end, 1, -std::max(0., excess_at(zone_end)), 0});
  return pieces;
}

SurfaceTrace::ValueAndSlope AdmissibleTrace::excess(unsigned int edge, double t) const {
  const auto& [begin, end, nodes] = discrete.edges()[edge];
  const double z = begin + t * (end - begin);
  const auto [value, slope] = discrete.value_and_slope(edge, t);
  return {value - phi(z), slope - phi.slope(z)};
}

AdmissibleTrace::Correction AdmissibleTrace::correction(unsigned int edge, const Piece& piece,
                                                        double t) const {
  if (piece.kind == Piece::Kind::outside) {
    const double slope = (piece.value_end - piece.value_begin) / (piece.t_end - piece.t_begin);
    const auto& [begin, end, nodes] = discrete.edges()[edge];
    return {piece.value_begin + slope * (t - piece.t_begin), slope / (end - begin), 0};
  }
  const auto [above, slope] = excess(edge, t);
  if (piece.kind == Piece::Kind::limited && above <= 0)
    return {0, 0, -above};
  return {-above, -slope, 0};
}

double AdmissibleTrace::displacement(unsigned int edge, const Piece& piece, double t) const {
  return discrete.value(edge, t) + correction(edge, piece, t).value;
}

} // namespace rollwave
