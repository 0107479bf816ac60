#include "true_errors.h"

#include "shape_products.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace rollwave {

using namespace dealii;

namespace {

/// u_h on r = b, one piece for each edge.
SurfaceFunction trace_of(const RingSpace& space, const FieldVector& field) {
  SurfaceFunction trace;
  const auto shapes = lobatto_lagrange(space.dof_handler().get_fe().degree);
  const auto values = std::make_shared<std::vector<double>>(space.surface_values(field));
  for (const SurfaceFace& face : space.surface_faces())
    trace.push_back({face.begin, face.end, [&face, values, shapes](double z) {
                       const double t = (z - face.begin) / (face.end - face.begin);
                       double sum = 0;
                       for (unsigned int i = 0; i < shapes.size(); ++i)
                         sum += (*values)[face.nodes[i]] * shapes[i].value(t);
                       return sum;
                     }});
  return trace;
}

/// The feasible displacement v on r = b.
SurfaceFunction trace_of(const RingSpace& space, const FeasibleTrace& feasible) {
  SurfaceFunction trace;
  for (unsigned int i = 0; i < space.surface_faces().size(); ++i) {
    const SurfaceFace& face = space.surface_faces()[i];
    const double length = face.end - face.begin;
    for (const auto& piece : feasible.pieces(i))
      trace.push_back({face.begin + piece.t_begin * length, face.begin + piece.t_end * length,
                       [&feasible, &piece, i, length, begin = face.begin](double z) {
                         return feasible.displacement(i, piece, (z - begin) / length);
                       }});
  }
  return trace;
}

/// a(u - v, u - v)^(1/2) of a displacement v by its trace, a(v, v) and (f, v).
double energy_distance(const Reference& reference, const SurfaceFunction& trace,
                       double norm_squared, double work_of_force) {
  const double squared =
      reference.norm_squared - 2 * (work_of_force - reference.contact_work(trace)) + norm_squared;
  return std::sqrt(std::max(squared, 0.));
}

} // namespace

TrueErrors measure_true_errors(const RingSpace& space, const FieldVector& field,
                               const Result& result, const std::optional<Certificate>& certificate,
                               const Reference& reference) {
  double pressure_squared = 0;
  for (unsigned int i = 0; i < result.contact_rows.size(); ++i) {
    const ContactRow& row = result.contact_rows[i];
    const double difference = row.pressure - reference.pressure(row.angle).value_or(row.pressure);
    pressure_squared += space.contact_nodes()[i].weight * difference * difference;
  }

  const double work = reference.work_of_force
                          ? reference.work_of_force(space, field)
                          : result.energy.norm_squared / 2 - result.energy.value;
  TrueErrors errors;
  errors.energy_norm =
      energy_distance(reference, trace_of(space, field), result.energy.norm_squared, work);
  errors.relative_energy_norm =
      reference.norm_squared > 0 ? errors.energy_norm / std::sqrt(reference.norm_squared) : 0;
  errors.l2_norm = reference.l2_distance ? reference.l2_distance(space, field)
                                         : std::numeric_limits<double>::quiet_NaN();
  errors.pressure = std::sqrt(pressure_squared);
  errors.force = std::abs(result.patch.force - reference.force);
  errors.energy = std::abs(result.energy.value - reference.energy);
  errors.half_width = std::abs(result.patch.half_width() - reference.half_width);
  const bool is_uniform = !space.dof_handler().get_triangulation().has_hanging_nodes();
  errors.expected_order =
      is_uniform ? reference.expected_order(result.mesh.degree) : result.mesh.degree;
  errors.is_resolved = errors.energy_norm >= reference.own_error;
  if (certificate) {
    const CertifiedError& certified = certificate->error;
    const double work_of_feasible = work + certificate->work_of_rest;
    const double energy = certified.norm_squared / 2 - work_of_feasible;
    errors.feasible_energy_norm = energy_distance(reference, trace_of(space, certificate->trace),
                                                  certified.norm_squared, work_of_feasible);
    // a(v - u, v - u) <= 2 (J(v) - J(u)) for every v in K: what is clearly more is the reference's.
    const double most = std::sqrt(2 * std::max(energy - reference.energy, 0.));
    if (*errors.feasible_energy_norm > 1.1 * most + reference.own_error)
      errors.is_resolved = false;
    if (energy > reference.energy)
      errors.effectivity = certified.energy_norm / std::sqrt(2 * (energy - reference.energy));
  }
  return errors;
}

} // namespace rollwave
