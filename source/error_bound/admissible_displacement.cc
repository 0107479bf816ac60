#include "rollwave/error_bound/admissible_displacement.h"

#include "rollwave/scene/scene.h"

#include <boost/math/tools/roots.hpp>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rollwave {

using namespace dealii;

AdmissibleRoad admissible_road(const ContactBoundary& boundary, const Scene& scene) {
  const Road& road = scene.road;
  double reach = 0;
  for (const SurfaceEdge& edge : boundary.space().surface_edges())
    for (const double x : {-road.tangent_angle(), road.tangent_angle()})
      if (from_lowest_point(edge.begin) <= x && x <= from_lowest_point(edge.end))
        reach = std::max(reach, edge.end - edge.begin);
  return {road, scene.phi, reach};
}

FieldVector project_contact_nodes(const ContactBoundary& boundary, const AdmissibleRoad& road,
                                  const std::vector<bool>& active, FieldVector field) {
  for (unsigned int i = 0; i < active.size(); ++i) {
    const SurfaceNode& node = boundary.contact_nodes()[i];
    if (!field.in_local_range(node.dof))
      continue;
    const double limit = road.limit(node.angle).value;
    field(node.dof) = active[i] ? limit : std::min(field(node.dof), limit);
  }
  boundary.space().constraints().distribute(field);
  field.update_ghost_values();
  return field;
}

namespace {

/// The zero of @p function between two places where it has different signs.
template <typename Function>
double root(const Function& function, double left, double right) {
  std::uintmax_t most_evaluations = 60;
  const auto bracket = boost::math::tools::toms748_solve(
      function, left, right, boost::math::tools::eps_tolerance<double>(40), most_evaluations);
  return (bracket.first + bracket.second) / 2;
}

/// What is known of a function on an interval.
struct Shape {
  bool has_one_sign;
  bool is_monotone;
  double size; ///< its largest value in size, at most
};

/// The shape of a function by its coefficients c_k of Chebyshev's polynomials T_k, from its values
/// at the @p points of Chebyshev in [0, 1]: |c_0| > sum_(k > 0) |c_k| means one sign, and
/// |c_1| > sum_(k > 1) k^2 |c_k| a derivative of one sign, since |T_k| <= 1 and |T_k'| <= k^2
/// there.
template <typename Function>
Shape shape_of(const Function& function, double begin, double end,
               const std::vector<Point<1>>& points) {
  std::vector<double> c(points.size());
  for (const Point<1>& point : points) {
    const double value = function(begin + (end - begin) * point[0]) / points.size(),
                 x = 2 * point[0] - 1;
    double before = 1, here = x; // T_(k - 1) and T_k
    c[0] += value;
    for (unsigned int k = 1; k < c.size(); ++k) {
      c[k] += 2 * value * here;
      before = std::exchange(here, 2 * x * here - before);
    }
  }
  double size = 0, size_of_slope = 0;
  for (unsigned int k = 0; k < c.size(); ++k) {
    size += std::abs(c[k]);
    size_of_slope += k * k * std::abs(c[k]);
  }
  return {2 * std::abs(c[0]) > size, 2 * std::abs(c[1]) > size_of_slope, size};
}

} // namespace

AdmissibleTrace::AdmissibleTrace(const ContactBoundary& boundary, const Scene& scene,
                                 const AdmissibleRoad& road, const FieldVector& field,
                                 const std::vector<bool>& active)
    : road(road), discrete(boundary.space(), field),
      chebyshev(QGaussChebyshev<1>(n_points() + 5).get_points()) {
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
  if (!(zone_begin < zone_end))
    return {{Piece::Kind::outside, 0, 1}};
  const auto kind =
      touches && zone_begin == 0 && zone_end == 1 ? Piece::Kind::touching : Piece::Kind::limited;
  std::vector<Piece> pieces;
  if (zone_begin > 0)
    pieces.push_back(
        {Piece::Kind::outside, 0, zone_begin, 0, -std::max(0., excess(edge, zone_begin).value)});
  const std::vector<double> cuts = smooth_stretches(edge, zone_begin, zone_end);
  for (unsigned int i = 0; i + 1 < cuts.size(); ++i)
    add_pieces(edge, {kind, cuts[i], cuts[i + 1]}, pieces);
  if (zone_end < 1)
    pieces.push_back(
        {Piece::Kind::outside, zone_end, 1, -std::max(0., excess(edge, zone_end).value), 0});
  return pieces;
}

std::vector<double> AdmissibleTrace::smooth_stretches(unsigned int edge, double t_begin,
                                                      double t_end) const {
  const auto& [begin, end, nodes] = discrete.edges()[edge];
  std::vector<double> cuts = {t_begin, t_end};
  const auto cut_at = [&](double t) {
    if (t_begin < t && t < t_end)
      cuts.push_back(t);
  };
  // At active nodes the excess vanishes.
  const QGaussLobatto<1> lobatto(nodes.size());
  for (const Point<1>& node : lobatto.get_points())
    cut_at(node[0]);
  for (const double x : road.corners())
    cut_at((x - from_lowest_point(begin)) / (end - begin));
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

void AdmissibleTrace::add_pieces(unsigned int edge, const Piece& piece,
                                 std::vector<Piece>& pieces) const {
  const auto& [begin, end, nodes] = discrete.edges()[edge];
  const double length = end - begin, middle = (piece.t_begin + piece.t_end) / 2;
  // Here nothing is left but round-off.
  constexpr double shortest = 1e-9;
  const bool is_short = piece.t_end - piece.t_begin < shortest;
  const auto add_both_sides_of = [&](double t) {
    add_pieces(edge, {piece.kind, piece.t_begin, t}, pieces);
    add_pieces(edge, {piece.kind, t, piece.t_end}, pieces);
  };
  if (!is_short && !road.is_resolved(begin + piece.t_begin * length, begin + piece.t_end * length))
    return add_both_sides_of(middle);
  if (is_short || piece.kind == Piece::Kind::touching) {
    pieces.push_back(piece);
    return;
  }
  const auto excess_at = [&](double t) { return excess(edge, t).value; };
  const Shape shape = shape_of(excess_at, piece.t_begin, piece.t_end, chebyshev);
  // That of the angle, whose size is about 5, counts where the road is steep.
  const double slope = road.limit(begin + middle * length).slope;
  const double round_off = 1e-14 * (std::abs(discrete.value(edge, middle)) + 5 * std::abs(slope));
  if (shape.has_one_sign || shape.size <= round_off)
    pieces.push_back(piece);
  else if (!shape.is_monotone)
    add_both_sides_of(middle);
  else if (!(excess_at(piece.t_begin) * excess_at(piece.t_end) < 0))
    pieces.push_back(piece);
  else {
    const double t = root(excess_at, piece.t_begin, piece.t_end);
    pieces.push_back({piece.kind, piece.t_begin, t});
    pieces.push_back({piece.kind, t, piece.t_end});
  }
}

SurfaceTrace::ValueAndSlope AdmissibleTrace::excess(unsigned int edge, double t) const {
  const auto& [begin, end, nodes] = discrete.edges()[edge];
  const auto [limit, slope_of_limit] = road.limit(begin + t * (end - begin));
  const auto [value, slope] = discrete.value_and_slope(edge, t);
  return {value - limit, slope - slope_of_limit};
}

AdmissibleTrace::Correction AdmissibleTrace::correction(unsigned int edge, const Piece& piece,
                                                        double t) const {
  const auto& [begin, end, nodes] = discrete.edges()[edge];
  const double length = end - begin;
  if (piece.kind == Piece::Kind::outside) {
    const double slope = (piece.value_end - piece.value_begin) / (piece.t_end - piece.t_begin);
    return {piece.value_begin + slope * (t - piece.t_begin), slope / length, 0};
  }
  const auto [above, slope] = excess(edge, t);
  const double z = begin + t * length, limit = road.limit(z).value;
  const double limit_to_road = road.upper(z) - limit; // 0 where they are the same
  if (piece.kind == Piece::Kind::limited && above <= 0)
    return {0, 0, limit_to_road - above};
  return {-above, -slope, limit_to_road};
}

double AdmissibleTrace::displacement(unsigned int edge, const Piece& piece, double t) const {
  return discrete.value(edge, t) + correction(edge, piece, t).value;
}

} // namespace rollwave
