#include "rollwave/error_bound/error_bound.h"

#include "rollwave/base/run_statistics.h"
#include "rollwave/error_bound/admissible_pressure.h"
#include "rollwave/error_bound/dual_system.h"
#include "rollwave/error_bound/force_integral.h"
#include "rollwave/mesh/line_elements.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// The fields of a Certificate. v = displacement + c xi, where c is the correction of the trace,
/// and xi is linear from 0 to 1 across the row of cells at the surface.
struct AdmissibleFields {
  const FieldVector& displacement; ///< u_h, with the contact nodes on the road or before it
  const AdmissibleTrace& trace;
  const std::vector<EdgePressure>& pressures; ///< lambda
  const FieldVector& potential;               ///< psi
  const ForceIntegral* force;                 ///< nullptr without force
};

/// Integrals over dr, or sums of them. They have a higher precision, so that sums over very many
/// cells are more accurate than the bounds of J are apart.
struct Integrals {
  long double bound_squared = 0; ///< eta^2; at_surface() adds the road's term
  long double norm_squared = 0;
  long double work_of_force = 0;

  void add(const Integrals& other, double weight) {
    bound_squared += weight * other.bound_squared;
    norm_squared += weight * other.norm_squared;
    work_of_force += weight * other.work_of_force;
  }
};

/// Integrates over one cell after another.
class CellIntegrals {
public:
  CellIntegrals(const RingSpace& space, const Scene& scene, const AdmissibleFields& fields,
                const RadialShapesOfMesh& shapes)
      : space(space), scene(scene), fields(fields), shapes(shapes),
        n(space.dof_handler().get_fe().degree + 1), lagrange(lobatto_lagrange(n - 1)),
        rule(fields.force ? fields.force->rule() : QGauss<1>(n)), along_road(n + 5),
        dofs(space.dof_handler()), u(n * n), psi(n * n), line_u(n), line_u_z(n), line_psi(n),
        line_psi_z(n) {
    for (const auto& point : rule.get_points())
      lines.emplace_back(lagrange, point[0]);
  }

  Integrals over(const DoFHandler<2>::active_cell_iterator& cell) {
    low = cell->vertex(0);
    high = cell->vertex(3);
    length = high[1] - low[1];
    height = high[0] - low[0];
    number = cell->active_cell_index();
    radial = &shapes.on(low[0], high[0]);
    const auto& of_cell = dofs.of(cell);
    for (unsigned int i = 0; i < of_cell.size(); ++i) {
      u[i] = fields.displacement(of_cell[i]);
      psi[i] = fields.potential(of_cell[i]);
    }
    if (const auto edge = space.surface_edge(cell))
      return at_surface(*edge);
    Integrals sums;
    for (unsigned int p = 0; p < rule.size(); ++p)
      sums.add(
          on_line(lines[p], {0, 0, 0}, fields.force ? fields.force->on_line(number, p) : nullptr),
          rule.weight(p) * length);
    return sums;
  }

private:
  /// Over a cell at the surface, where v differs from u_h: adds the road's term.
  Integrals at_surface(unsigned int edge) {
    Integrals sums;
    for (const auto& piece : fields.trace.pieces(edge))
      for (unsigned int p = 0; p < along_road.size(); ++p) {
        const double share = piece.t_end - piece.t_begin;
        const double t = piece.t_begin + share * along_road.point(p)[0];
        const double weight = along_road.weight(p) * share * length;
        const auto correction = fields.trace.correction(edge, piece, t);
        const ShapesAtPoint angular(lagrange, t);
        if (fields.force)
          fields.force->values_on_line_at(number, t, line_q);
        sums.add(on_line(angular, correction, fields.force ? line_q.data() : nullptr), weight);
        sums.bound_squared +=
            2 * weight * scene.outer_radius * fields.pressures[edge](t) * correction.gap;
      }
    return sums;
  }

  /// @param q_h values of Q_h at the radii of the cell; nullptr without force
  Integrals on_line(const ShapesAtPoint& angular, const AdmissibleTrace::Correction& correction,
                    const double* q_h) {
    for (unsigned int i = 0; i < n; ++i) {
      line_u[i] = line_u_z[i] = line_psi[i] = line_psi_z[i] = 0;
      for (unsigned int j = 0; j < n; ++j) {
        line_u[i] += angular.value[j] * u[i + n * j];
        line_u_z[i] += angular.derivative[j] * u[i + n * j];
        line_psi[i] += angular.value[j] * psi[i + n * j];
        line_psi_z[i] += angular.derivative[j] * psi[i + n * j];
      }
      line_u_z[i] /= length;
      line_psi_z[i] /= length;
    }
    const double correction_r = correction.value / height;
    Integrals sums;
    for (unsigned int q = 0; q < radial->r.size(); ++q) {
      const double r = radial->r[q], alpha = radial->alpha[q], weight = radial->weight[q];
      double v_r = correction_r, v_z = correction.slope * (r - low[0]) / height;
      double psi_s = 0, psi_z = 0;
      for (unsigned int i = 0; i < n; ++i) {
        const RadialShape& shape = radial->shapes[n * q + i];
        v_r += shape.derivative * line_u[i];
        v_z += shape.value * line_u_z[i];
        psi_s += shape.potential_s * line_psi[i];
        psi_z += shape.potential * line_psi_z[i];
      }
      const double q_h_here = q_h ? q_h[q] : 0;
      const double z_part = psi_s + v_z;                // tau_z = -alpha psi_s
      const double r_part = q_h_here - psi_z - r * v_r; // r tau_r = Q_h - psi_z
      sums.bound_squared +=
          weight * r * alpha * z_part * z_part + radial->weight_over_r[q] * r_part * r_part;
      sums.norm_squared += weight * r * (alpha * v_z * v_z + v_r * v_r);
      sums.work_of_force += weight * q_h_here * v_r;
    }
    return sums;
  }

  const RingSpace& space;
  const Scene& scene;
  const AdmissibleFields& fields;
  const RadialShapesOfMesh& shapes;
  const unsigned int n;
  const std::vector<Polynomials::Polynomial<double>> lagrange;
  const QGauss<1> rule, along_road;
  std::vector<ShapesAtPoint> lines; ///< of the rule
  LexicographicDofs dofs;
  std::vector<double> u, psi; ///< values at those of the cell
  Point<2> low, high;
  double length = 0, height = 0;
  unsigned int number = 0; ///< of the active cell
  const RadialShapes* radial = nullptr;
  /// The values of u, psi, their z-derivatives and Q_h along a line.
  std::vector<double> line_u, line_u_z, line_psi, line_psi_z, line_q;
};

/// The integrals over all cells, and the error bound of each own cell.
std::pair<Integrals, std::vector<double>> integrate(const RingSpace& space, const Scene& scene,
                                                    const AdmissibleFields& fields,
                                                    const RadialShapesOfMesh& shapes) {
  CellIntegrals integrals(space, scene, fields, shapes);
  std::vector<double> cell_bounds(space.dof_handler().get_triangulation().n_active_cells());
  Integrals total;
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Integrals of_cell = integrals.over(cell);
    const unsigned int number = cell->active_cell_index();
    const double force_data = fields.force ? fields.force->cell_error_squared(number) : 0;
    cell_bounds[number] = std::sqrt(std::max(double(of_cell.bound_squared), 0.) + force_data);
    total.add(of_cell, 1);
  }
  for (long double* const sum : {&total.bound_squared, &total.norm_squared, &total.work_of_force})
    *sum = Utilities::MPI::sum(*sum, space.communicator());
  return {total, std::move(cell_bounds)};
}

/// The bounds that eta, delta and the integrals of v give.
CertifiedError bound_error(const Scene& scene, const Integrals& integrals,
                           const ForceIntegral* force) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double delta = force ? force->error() : 0, sampled_width = force ? force->scan_width() : 0;
  const double eta = std::sqrt(std::max(double(integrals.bound_squared), 0.));
  const double norm_squared = integrals.norm_squared, work_of_force = integrals.work_of_force;
  if (!std::isfinite(delta))
    return {infinity, delta, infinity, -infinity, infinity, norm_squared, sampled_width};
  const double energy_norm = eta + delta;
  const double energy = norm_squared / 2 - work_of_force;
  // The heights of cells and Q_h are differences of radii, which cancel in a thin ring.
  const double cancellation = scene.outer_radius / (scene.outer_radius - scene.inner_radius);
  const double round_off = 1e-15 * cancellation * (norm_squared + std::abs(work_of_force));
  const double energy_error = delta * std::sqrt(norm_squared) + round_off;
  // A lower bound of |u|. Below 1e-9 of the error bound it is round-off.
  const double smallest_norm = std::sqrt(norm_squared) - energy_norm;
  const bool has_digits = smallest_norm > 1e-9 * energy_norm;
  return {energy_norm,
          delta,
          energy_norm == 0 ? 0
          : has_digits     ? energy_norm / smallest_norm
                           : infinity,
          energy - energy_error - eta * eta / 2 - delta * energy_norm,
          energy + energy_error,
          norm_squared,
          sampled_width};
}

} // namespace

Certificate certify(const ContactBoundary& boundary, const Scene& scene,
                    const ContactProblem& problem, const ContactSolution& contact,
                    const FieldVector& field, const ForceIntegral* force, const DualSystem& dual,
                    RunStatistics& statistics) {
  const RunStatistics::Phase phase(statistics, "certificate");
  const FieldVector displacement = project_contact_nodes(boundary, problem, contact.active, field);
  const AdmissibleTrace trace(boundary, scene, displacement, contact.active);
  const auto pressures = admissible_pressures(boundary, scene, contact);
  const FieldVector potential = dual.stress_function(scene, pressures, force, statistics);
  auto [integrals, cell_bounds] = integrate(
      boundary.space(), scene, {displacement, trace, pressures, potential, force}, dual.shapes());
  return {bound_error(scene, integrals, force), std::move(cell_bounds), trace,
          double(integrals.work_of_force)};
}

} // namespace rollwave
