#include "true_errors.h"

#include "exact_field.h"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace rollwave {

using namespace dealii;

namespace {

/// int lambda u_h dz over one edge, where the pressure may begin or end inside.
double work_of_pressure(const SurfaceFace& face, const FieldVector& field,
                        const std::vector<Polynomials::Polynomial<double>>& shapes,
                        const ContactPressureSeries& pressure) {
  const double begin = std::max(face.begin, pressure.middle() - pressure.half_width());
  const double end = std::min(face.end, pressure.middle() + pressure.half_width());
  if (!(begin < end))
    return 0;
  const auto displacement = [&](double z) {
    const double t = (z - face.begin) / (face.end - face.begin);
    double sum = 0;
    for (unsigned int i = 0; i < shapes.size(); ++i)
      sum += field(face.dofs[i]) * shapes[i].value(t);
    return sum;
  };
  const double length = face.end - face.begin;
  const bool has_end = pressure.middle() - pressure.half_width() > face.begin - length / 4 ||
                       pressure.middle() + pressure.half_width() < face.end + length / 4;
  if (!has_end)
    return boost::math::quadrature::gauss<double, 20>::integrate(
        [&](double z) { return pressure(z) * displacement(z); }, begin, end);
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
               std::pow(std::sin(x), 2 * pressure.order()) * displacement(z);
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
    values.reinit(cell);
    values.get_function_values(field, displacement);
    for (const unsigned int q : values.quadrature_point_indices()) {
      const Point<2> point = values.quadrature_point(q);
      const double u = cosine_sum(*series.at(key(point[0])), point[1] - exact.pressure.middle());
      squared += point[0] * (u - displacement[q]) * (u - displacement[q]) * values.JxW(q);
    }
  }
  return std::sqrt(squared);
}

} // namespace

TrueErrors measure_true_errors(const RingSpace& space, const FieldVector& field,
                               const Result& result, const ExactSolution& exact) {
  const QGaussLobatto<1> lobatto(space.dof_handler().get_fe().degree + 1);
  const auto shapes = Polynomials::generate_complete_Lagrange_basis(lobatto.get_points());

  double pressure_times_u = 0;
  if (exact.half_width > 0)
    for (const SurfaceFace& face : space.surface_faces())
      pressure_times_u +=
          space.outer_radius() * work_of_pressure(face, field, shapes, exact.pressure);
  const double work_of_force = result.energy.norm_squared / 2 - result.energy.value;
  const double energy_squared =
      exact.norm_squared - 2 * (work_of_force - pressure_times_u) + result.energy.norm_squared;

  double pressure_squared = 0;
  for (unsigned int i = 0; i < result.contact_rows.size(); ++i) {
    const ContactRow& row = result.contact_rows[i];
    const double distance =
        std::abs(std::abs(row.angle - exact.pressure.middle()) - exact.half_width);
    const bool is_singular = exact.end_exponent < 0 && distance < 1e-12;
    const double difference = is_singular ? 0 : row.pressure - exact.pressure(row.angle);
    pressure_squared += space.contact_nodes()[i].weight * difference * difference;
  }

  TrueErrors errors;
  errors.energy_norm = std::sqrt(std::max(energy_squared, 0.));
  errors.relative_energy_norm =
      exact.norm_squared > 0 ? errors.energy_norm / std::sqrt(exact.norm_squared) : 0;
  errors.l2_norm = l2_error(space, field, exact);
  errors.pressure = std::sqrt(pressure_squared);
  errors.force = std::abs(result.patch.force - exact.force);
  errors.energy = std::abs(result.energy.value - exact.energy);
  errors.half_width = std::abs(result.patch.half_width() - exact.half_width);
  errors.expected_order = exact.end_exponent < 0 ? 0.5 : std::min<double>(result.mesh.degree, 1.5);
  return errors;
}

} // namespace rollwave
