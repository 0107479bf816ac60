#include "true_errors.h"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

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
  errors.pressure = std::sqrt(pressure_squared);
  errors.force = std::abs(result.patch.force - exact.force);
  errors.energy = std::abs(result.energy.value - exact.energy);
  errors.half_width = std::abs(result.patch.half_width() - exact.half_width);
  errors.expected_order = exact.end_exponent < 0 ? 0.5 : std::min<double>(result.mesh.degree, 1.5);
  return errors;
}

} // namespace rollwave
