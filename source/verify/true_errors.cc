#include "rollwave/verify/true_errors.h"

#include "rollwave/base/text.h"
#include "rollwave/exact/exact_field.h"
#include "rollwave/mesh/surface_trace.h"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace rollwave {

using namespace dealii;

namespace {

/// A continuous function w on r = b in pieces that are smooth, by increasing angle; the angles are
/// those of SurfaceEdge.
struct SurfacePiece {
  double begin;
  double end;
  std::function<double(double z)> value;
};
using SurfaceFunction = std::vector<SurfacePiece>;

/// int lambda w dz over one piece, where the pressure may begin or end inside.
double pressure_times(const SurfacePiece& piece, const GegenbauerPressure& pressure) {
  const double begin = std::max(piece.begin, pressure.middle() - pressure.half_width());
  const double end = std::min(piece.end, pressure.middle() + pressure.half_width());
  if (!(begin < end))
    return 0;
  const double length = piece.end - piece.begin;
  const bool has_end = pressure.middle() - pressure.half_width() > piece.begin - length / 4 ||
                       pressure.middle() + pressure.half_width() < piece.end + length / 4;
  if (!has_end)
    return boost::math::quadrature::gauss<double, 20>::integrate(
        [&](double z) { return pressure(z) * piece.value(z); }, begin, end);
  // The substitution z = m - w cos(x), t = (z - m)/w, turns (1 - t^2)^(nu - 1/2) dt into
  // sin(x)^(2 nu) dx, which is not singular.
  const auto angle = [&](double z) {
    return std::acos(std::clamp((pressure.middle() - z) / pressure.half_width(), -1., 1.));
  };
  boost::math::quadrature::tanh_sinh<double> rule;
  return rule.integrate(
      [&](double x) {
        const double z = pressure.middle() - pressure.half_width() * std::cos(x);
        return pressure.over_weight(z) * pressure.half_width() *
               std::pow(std::sin(x), 2 * pressure.order()) * piece.value(z);
      },
      angle(begin), angle(end), 1e-12);
}

/// Squared integrals of the error e = u - u_h.
struct FieldErrors {
  double value; ///< int r e^2 dr dz
  double slope; ///< int r e_z^2 dr dz
};

/// By Gauss' rule. Points of a mesh share few radii, for each of which u is a series over the
/// angle.
FieldErrors field_errors(const RingSpace& space, const FieldVector& field,
                         const ExactSolution& exact) {
  const auto& element = space.dof_handler().get_fe();
  const QGauss<2> gauss(element.degree + 2);
  FEValues<2> values(space.mapping(), element, gauss,
                     update_values | update_gradients | update_quadrature_points |
                         update_JxW_values);
  // Round-off in the vertices must not make two radii of one.
  const double resolution = 1e-10 * space.outer_radius();
  const auto key = [resolution](double r) { return std::llround(r / resolution); };

  std::map<long long, double> radii;
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    values.reinit(cell);
    for (const Point<2>& point : values.get_quadrature_points())
      radii.emplace(key(point[0]), point[0]);
  }
  std::vector<double> list;
  for (const auto& [rounded, r] : radii)
    list.push_back(r);
  // Modes that the mesh cannot resolve by far are no part of its error.
  const unsigned int n_modes = 4 * space.surface_nodes().size() + 50;
  const auto coefficients = cosine_coefficients(exact, n_modes, list);
  std::map<long long, const std::vector<double>*> series;
  for (const auto& [rounded, r] : radii)
    series[rounded] = &coefficients[series.size()];

  std::vector<double> displacement(gauss.size());
  std::vector<Tensor<1, 2>> gradient(gauss.size());
  FieldErrors own = {};
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    values.reinit(cell);
    values.get_function_values(field, displacement);
    values.get_function_gradients(field, gradient);
    for (const unsigned int q : values.quadrature_point_indices()) {
      const Point<2> point = values.quadrature_point(q);
      const auto [u, u_z] = cosine_sum(*series.at(key(point[0])), point[1]);
      const double weight = point[0] * values.JxW(q), difference = u - displacement[q],
                   of_slope = u_z - gradient[q][1];
      own.value += weight * difference * difference;
      own.slope += weight * of_slope * of_slope;
    }
  }
  return {Utilities::MPI::sum(own.value, space.communicator()),
          Utilities::MPI::sum(own.slope, space.communicator())};
}

/// u_h on r = b, one piece for each edge.
SurfaceFunction pieces_of(const SurfaceTrace& trace) {
  SurfaceFunction pieces;
  for (unsigned int i = 0; i < trace.edges().size(); ++i) {
    const SurfaceEdge& edge = trace.edges()[i];
    pieces.push_back({edge.begin, edge.end, [&trace, &edge, i](double z) {
                        return trace.value(i, (z - edge.begin) / (edge.end - edge.begin));
                      }});
  }
  return pieces;
}

/// The admissible displacement v on r = b.
SurfaceFunction pieces_of(const RingSpace& space, const AdmissibleTrace& trace) {
  SurfaceFunction pieces;
  for (unsigned int i = 0; i < space.surface_edges().size(); ++i) {
    const SurfaceEdge& edge = space.surface_edges()[i];
    const double length = edge.end - edge.begin;
    for (const auto& piece : trace.pieces(i))
      pieces.push_back({edge.begin + piece.t_begin * length, edge.begin + piece.t_end * length,
                        [&trace, &piece, i, length, begin = edge.begin](double z) {
                          return trace.displacement(i, piece, (z - begin) / length);
                        }});
  }
  return pieces;
}

/// b int lambda w dz
double contact_work(const ExactSolution& exact, const SurfaceFunction& w) {
  double sum = 0;
  if (exact.half_width > 0)
    for (const SurfacePiece& piece : w)
      sum += exact.scene.outer_radius * pressure_times(piece, exact.pressure);
  return sum;
}

/// a(u - v, u - v)^(1/2) of a displacement v by its trace, a(v, v) and (f, v).
double energy_distance(const ExactSolution& exact, const SurfaceFunction& trace,
                       double norm_squared, double work_of_force) {
  const double squared =
      exact.norm_squared - 2 * (work_of_force - contact_work(exact, trace)) + norm_squared;
  return std::sqrt(std::max(squared, 0.));
}

/// |lambda - lambda_h|^2 by the rule [.,.]_h, nodes at which lambda is infinite left out.
double pressure_distance_squared(const ExactSolution& exact, const Result& result) {
  double squared = 0;
  for (const ContactRow& row : result.contact_rows) {
    const double distance =
        std::abs(std::abs(row.angle - exact.pressure.middle()) - exact.half_width);
    if (exact.end_exponent >= 0 || distance >= 1e-12)
      squared += row.weight * std::pow(row.pressure - exact.pressure(row.angle), 2);
  }
  return squared;
}

/// The error in the energy norm that cancellation hides.
double hidden_error(const ExactSolution& exact) {
  const bool is_cut = exact.end_exponent < 0;
  return (is_cut ? 3e-5 : 5e-6) * std::sqrt(exact.norm_squared);
}

/// TrueErrors::expected_order, by the exponent of the pressure at the ends.
double expected_order(double degree, bool is_uniform, double end_exponent) {
  const bool is_cut = end_exponent < 0;
  const bool is_critical = end_exponent > -0.4; // -1/2 or -1/3 if cut
  if (is_uniform)
    return is_cut ? 0.5 : std::min(degree, 1.5);
  // At the critical speed what has the length l along z reaches l^(2/3) deep, so that l^(-1/3)
  // square cells lie next to an end that is graded down to the size l. The end leaves l^(1/2).
  return is_cut && is_critical ? std::min(degree, 3.) : degree;
}

} // namespace

TrueErrors measure_true_errors(const Solution& solution, const ExactSolution& exact) {
  const RingSpace& space = solution.space();
  const FieldVector& field = solution.displacement;
  const Result& result = solution.result;
  const double floor = hidden_error(exact);
  const double work = result.energy.norm_squared / 2 - result.energy.value; // (f, u_h)

  const SurfaceTrace trace(space, field);
  TrueErrors errors;
  errors.energy_norm = energy_distance(exact, pieces_of(trace), result.energy.norm_squared, work);
  errors.relative_energy_norm =
      exact.norm_squared > 0 ? errors.energy_norm / std::sqrt(exact.norm_squared) : 0;
  const FieldErrors of_field = field_errors(space, field, exact);
  errors.l2_norm = std::sqrt(of_field.value);
  errors.pressure = std::sqrt(pressure_distance_squared(exact, result));
  errors.force = std::abs(result.contact.loads.total - exact.loads.total);
  errors.energy = std::abs(result.energy.value - exact.energy);
  errors.half_width = std::abs(result.contact.half_width() - exact.half_width);
  const bool is_uniform =
      result.cycles.size() == 1 || !space.dof_handler().get_triangulation().has_hanging_nodes();
  errors.expected_order = expected_order(result.mesh.degree, is_uniform, exact.end_exponent);
  errors.is_resolved = errors.energy_norm >= floor;
  const double omega = exact.scene.angular_velocity, b = exact.scene.outer_radius;
  if (omega * b < 1) // 1/r^2 = alpha + omega^2
    errors.h1_norm = std::sqrt(of_field.value / (b * b) + std::pow(errors.energy_norm, 2) +
                               omega * omega * of_field.slope);
  if (const auto& certificate = solution.certificate) {
    const CertifiedError& certified = certificate->error;
    const double work_on_v = certificate->work_of_force; // (f, v)
    const double energy = certified.norm_squared / 2 - work_on_v;
    const double error_of_v = energy_distance(exact, pieces_of(space, certificate->trace),
                                              certified.norm_squared, work_on_v);
    // a(v - u, v - u) <= 2 (J(v) - J(u)) for every v in K: what is clearly more is the exact
    // answer's own error.
    const double most = std::sqrt(2 * std::max(energy - exact.energy, 0.));
    if (error_of_v > 1.1 * most + floor)
      errors.is_resolved = false;
    if (errors.is_resolved && errors.energy_norm > 0)
      errors.effectivity = certified.energy_norm / errors.energy_norm;
  }
  return errors;
}

std::vector<Note> contradicted_guarantees(const Result& result, const ExactSolution& exact,
                                          const Units& units) {
  std::vector<Note> notes;
  if (!result.certified)
    return notes;
  const auto check = [&](const char* words, double number, const Interval& guaranteed,
                         double accuracy, Quantity quantity) {
    if (guaranteed.lower - accuracy <= number && number <= guaranteed.upper + accuracy)
      return;
    const double unit = units.of(quantity);
    notes.push_back(
        {Note::Kind::shortfall, std::string("A GUARANTEE IS WRONG: ") + words + " IS " +
                                    rounded(number * unit, 12) + ", THE GUARANTEE IS FROM " +
                                    rounded(guaranteed.lower * unit, 12) + " TO " +
                                    rounded(guaranteed.upper * unit, 12) + units.after(quantity)});
  };
  const CertifiedError& certified = *result.certified;
  if (result.errors && result.errors->is_resolved)
    check("THE TRUE ERROR IN THE ENERGY NORM", result.errors->energy_norm,
          {0, certified.energy_norm}, hidden_error(exact), Quantity::energy_norm);
  constexpr double safety = 10; // accuracies are estimates
  check("THE EXACT ENERGY J", exact.energy, {certified.lower_bound, certified.upper_bound},
        safety * exact.energy_accuracy * std::abs(exact.energy), Quantity::energy);
  check("THE EXACT CONTACT FORCE", exact.loads.total, certified.loads.total,
        safety * exact.force_accuracy * exact.loads.total, Quantity::force);
  check("THE EXACT VERTICAL LOAD", exact.loads.vertical, certified.loads.vertical,
        safety * exact.force_accuracy * exact.loads.total, Quantity::force);
  return notes;
}

} // namespace rollwave
