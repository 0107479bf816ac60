#include "reference.h"

#include "assembly.h"
#include "exact_field.h"
#include "scene.h"
#include "work_of_force.h"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

namespace rollwave {

using namespace dealii;

namespace {

/// int lambda w dz over one piece, where the pressure may begin or end inside.
double pressure_times(const SurfacePiece& piece, const ContactPressureSeries& pressure) {
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
  // With z = m - w cos(x) the weight sin(x)^(2 nu) is left of (1 - t^2)^(nu - 1/2) dt, which is no
  // longer singular.
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

/// sum_k c_k cos(k x) by Clenshaw's recurrence.
double cosine_sum(const std::vector<double>& coefficients, double x) {
  const double factor = 2 * std::cos(x);
  double first = 0, second = 0;
  for (std::size_t k = coefficients.size() - 1; k > 0; --k) {
    const double next = coefficients[k] + factor * first - second;
    second = first;
    first = next;
  }
  return coefficients[0] + factor / 2 * first - second;
}

/// The L2 norm of u - u_h. Points of a mesh share few radii, for each of which u is a series over
/// the angle.
double l2_error(const RingSpace& space, const FieldVector& field, const ExactSolution& exact) {
  const auto& element = space.dof_handler().get_fe();
  const QGauss<2> gauss(element.degree + 2);
  FEValues<2> values(space.mapping(), element, gauss,
                     update_values | update_quadrature_points | update_JxW_values);
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
  const unsigned int n_modes = 2 * space.surface_nodes().size() + 50;
  const auto coefficients = ExactField(exact.scene, exact, n_modes).cosine_coefficients(list);
  std::map<long long, const std::vector<double>*> series;
  for (const auto& [rounded, r] : radii)
    series[rounded] = &coefficients[series.size()];

  std::vector<double> displacement(gauss.size());
  double squared = 0;
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    values.reinit(cell);
    values.get_function_values(field, displacement);
    for (const unsigned int q : values.quadrature_point_indices()) {
      const Point<2> point = values.quadrature_point(q);
      const double u = cosine_sum(*series.at(key(point[0])), point[1] - exact.pressure.middle());
      squared += point[0] * (u - displacement[q]) * (u - displacement[q]) * values.JxW(q);
    }
  }
  return std::sqrt(Utilities::MPI::sum(squared, space.communicator()));
}

/// Free ends allow 3/2 at most, ends cut short by the zone 1/2.
double order_on_uniform_meshes(bool is_cut, unsigned int degree) {
  return is_cut ? 0.5 : std::min<double>(degree, 1.5);
}

} // namespace

Reference exact_reference(const ExactSolution& exact) {
  const double b = exact.scene.outer_radius;
  Reference reference;
  reference.name = "the semi-analytic solution";
  reference.force = exact.force;
  reference.energy = exact.energy;
  reference.norm_squared = exact.norm_squared;
  // See measure_true_errors().
  const double floor = exact.end_exponent < 0 ? 1e-5 : 5e-6;
  reference.own_error = floor * std::sqrt(exact.norm_squared);
  reference.half_width = exact.half_width;
  reference.contact_work = [b, exact](const SurfaceFunction& w) {
    double sum = 0;
    if (exact.half_width > 0)
      for (const SurfacePiece& piece : w)
        sum += b * pressure_times(piece, exact.pressure);
    return sum;
  };
  reference.pressure = [exact](double z) -> std::optional<double> {
    const double distance = std::abs(std::abs(z - exact.pressure.middle()) - exact.half_width);
    if (exact.end_exponent < 0 && distance < 1e-12)
      return {};
    return exact.pressure(z);
  };
  reference.l2_distance = [exact](const RingSpace& space, const FieldVector& field) {
    return l2_error(space, field, exact);
  };
  reference.expected_order = [is_cut = exact.end_exponent < 0](unsigned int degree) {
    return order_on_uniform_meshes(is_cut, degree);
  };
  return reference;
}

Reference discrete_reference(const Scene& scene, const RingSpace& space, const Result& result,
                             const Certificate& certificate, const std::string& name) {
  struct Node {
    double angle;
    double force;
  };
  std::vector<Node> nodes;
  double work_of_road = 0;
  for (unsigned int i = 0; i < result.contact_rows.size(); ++i) {
    const ContactRow& row = result.contact_rows[i];
    nodes.push_back({row.angle, row.pressure * space.contact_nodes()[i].weight});
    work_of_road += nodes.back().force * row.road;
  }
  // Where the zone cuts the contact short, the pressure is infinite.
  const auto [left, right] = result.patch.ends.value_or(std::pair(0., 0.));
  const bool is_cut_left = result.patch.ends && left == scene.zone_begin;
  const bool is_cut_right = result.patch.ends && right == scene.zone_end;
  Reference reference;
  reference.name = name;
  reference.own_error = result.certified->energy_norm;
  reference.force = result.patch.force;
  if (scene.has_uneven_force()) {
    const auto force = std::make_shared<ForceInterpolant>(
        space, scene, assemble_load(space, scene).moments, RadialExtents(space));
    reference.work_of_force = [force](const RingSpace& other, const FieldVector& field) {
      return rollwave::work_of_force(*force, other, field);
    };
  }
  // J(v) errs by half the square of the error only, J(u_h) by that of the load as well.
  reference.energy = certificate.energy;
  reference.norm_squared = -2 * (certificate.energy + work_of_road);
  reference.half_width = result.patch.half_width();
  reference.contact_work = [nodes](const SurfaceFunction& w) {
    double sum = 0;
    for (const Node& node : nodes) {
      if (node.force == 0)
        continue;
      for (const double turn : {0., 2 * numbers::PI, -2 * numbers::PI}) {
        const double z = node.angle + turn;
        const auto piece = std::find_if(w.begin(), w.end(), [z](const SurfacePiece& candidate) {
          return candidate.begin <= z && z <= candidate.end;
        });
        if (piece != w.end()) {
          sum += node.force * piece->value(z);
          break;
        }
      }
    }
    return sum;
  };
  reference.pressure = [=, rows = result.contact_rows, left = left,
                        right = right](double z) -> std::optional<double> {
    if ((is_cut_left && std::abs(z - left) < 1e-12) ||
        (is_cut_right && std::abs(z - right) < 1e-12))
      return {};
    return pressure_at(rows, z);
  };
  reference.expected_order = [is_cut = is_cut_left || is_cut_right](unsigned int degree) {
    return order_on_uniform_meshes(is_cut, degree);
  };
  return reference;
}

} // namespace rollwave
