#include "certificate.h"

#include "angular_bubbles.h"
#include "certificate_parts.h"
#include "constant_size.h"
#include "edge_pressure.h"
#include "force_columns.h"
#include "interval_map.h"
#include "lexicographic_dofs.h"
#include "mesh_system.h"
#include "parameters.h"
#include "potential_kinks.h"
#include "scene.h"
#include "work.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace rollwave {

using namespace dealii;

namespace {

/// At the nodes on one side of a cell.
using NodeValues = std::array<double, highest_degree + 1>;

/// Shape functions in z at one point t = (z - begin)/(end - begin) of a cell.
struct AngularShapes {
  double t;
  NodeValues value, derivative; ///< the latter d/dt
  double bubble;                ///< of AngularBubbles: beta
  double mode;                  ///< P

  AngularShapes(const std::vector<Polynomials::Polynomial<double>>& lagrange,
                const Polynomials::Polynomial<double>& beta, double t)
      : t(t) {
    double both[2];
    for (unsigned int j = 0; j < lagrange.size(); ++j) {
      lagrange[j].value(t, 1, both);
      value[j] = both[0];
      derivative[j] = both[1];
    }
    beta.value(t, 1, both);
    bubble = both[0];
    mode = both[1];
  }
};

/// The integrals over a line z = const of a cell, each over dr, or sums of them: in a higher
/// precision, lest those over very many cells be off by more than the bounds of J are apart.
template <typename Number>
struct Integrals {
  Number bound_squared = 0; ///< of eta^2 without the road's term
  Number norm_squared = 0;  ///< of a(v, v)
  Number work_of_force = 0; ///< of (f_0, v) = int G v_r dr dz
  Number work_of_rest = 0;  ///< of (f_0, v - u_h)

  template <typename Other>
  void add(const Integrals<Other>& other, double weight) {
    bound_squared += weight * other.bound_squared;
    norm_squared += weight * other.norm_squared;
    work_of_force += weight * other.work_of_force;
    work_of_rest += weight * other.work_of_rest;
  }
};

using LineIntegrals = Integrals<double>;
using Sums = Integrals<long double>;

/// The sums over all processes.
LineIntegrals sums_over(MPI_Comm communicator, const Sums& own) {
  std::vector<long double> sums = {own.bound_squared, own.norm_squared, own.work_of_force,
                                   own.work_of_rest};
  Utilities::MPI::sum(sums, communicator, sums);
  return {double(sums[0]), double(sums[1]), double(sums[2]), double(sums[3])};
}

class Integrator {
public:
  Integrator(const RingSpace& space, const FieldVector& displacement, const FieldVector& potential,
             const AngularBubbles& bubbles, RadialShapesOfMesh& shapes, ForceColumns* columns,
             const ForceJumps& jumps)
      : displacement(displacement), potential(potential), bubbles(bubbles), shapes(shapes),
        columns(columns), jumps(jumps), n(space.dof_handler().get_fe().degree + 1),
        lagrange(lobatto_lagrange(n - 1)), beta(AngularBubbles::mode(n - 1).primitive()),
        dofs(space.dof_handler()), u(n * n), psi(n * n), g(n) {
    const Polynomials::Legendre highest(n);
    const QGauss<1> gauss(n + 1);
    for (unsigned int q = 0; q < gauss.size(); ++q) {
      const double t = gauss.point(q)[0];
      unseen_share += gauss.weight(q) * highest.value(t) * beta.value(t);
    }
  }

  void reinit(const DoFHandler<2>::active_cell_iterator& cell) {
    low = cell->vertex(0);
    high = cell->vertex(3);
    length = high[1] - low[1];
    per_length = 1 / length;
    per_height = 1 / (high[0] - low[0]);
    radial = &shapes.on(low[0], high[0]);
    const auto& of_cell = dofs.of(cell);
    for (unsigned int i = 0; i < of_cell.size(); ++i) {
      u[i] = displacement(of_cell[i]);
      psi[i] = potential(of_cell[i]);
    }
    bubbles.values(of_cell, g);
    if (!columns)
      return;
    if (columns->has_equal_lines())
      equal_moments = &columns->equal_integrals(low[0], high[0], *radial);
    else {
      lines = &columns->on(low[1], high[1]);
      at_radii = &columns->at_radii(low[0], high[0], *radial);
      kinks = kinks_of_cell(jumps, low, high, n - 1);
    }
  }

  /// The lines of a force whose rule along z is not that of the cell; nullptr without them.
  const ForceLines* own_lines() const {
    return lines && !lines->has_rule_of_cell() ? lines : nullptr;
  }

  /// G at the radii of the rule, on the line number @p p of the rule along z and on any line of the
  /// cell; nullptr without force.
  const std::vector<double>* moments_on(unsigned int p) {
    return lines ? &moments_of(lines->columns[p]) : equal_moments;
  }
  const std::vector<double>* moments_at(double t) {
    return lines ? &moments_of(columns->at(low[1] + t * (high[1] - low[1]), low[0]))
                 : equal_moments;
  }

  /// On one line, with the correction c of v on the surface.
  LineIntegrals on_line(const AngularShapes& angular, const FeasibleTrace::Correction& correction,
                        const std::vector<double>* moments) const {
    return with_constant_size(
        n, [&](auto size) { return on_line_of(size, angular, correction, moments); });
  }

  /// What a rule of degree + 1 points in z does not see of int (psi_s + v_z)^2 ds dz: the bubbles'
  /// share of Legendre's polynomial of degree + 1, which vanishes there.
  double unseen_square() const {
    // Square by square: the form of g in the stiffness matrix cancels where the mean of g prevails.
    double square = 0;
    for (unsigned int q = 0; q < radial->r.size(); ++q) {
      double g_s = 0;
      for (unsigned int i = 0; i < n; ++i)
        g_s += radial->shapes[n * q + i].potential_s * g[i];
      square += radial->weight[q] * radial->r[q] * radial->alpha[q] * g_s * g_s;
    }
    return length * length * length * unseen_share * unseen_share * square;
  }

  /// g on r = b.
  double surface_bubble() const { return g.back(); }
  double angular_length() const { return length; }
  bool ends_at(double radius) const { return high[0] == radius; }
  AngularShapes angular_shapes(double t) const { return AngularShapes(lagrange, beta, t); }
  std::vector<AngularShapes> angular_shapes(const Quadrature<1>& rule) const {
    std::vector<AngularShapes> shapes;
    for (const auto& point : rule.get_points())
      shapes.push_back(angular_shapes(point[0]));
    return shapes;
  }

private:
  /// With @p n shape functions in each direction.
  template <typename Size>
  LineIntegrals on_line_of(Size n, const AngularShapes& angular,
                           const FeasibleTrace::Correction& correction,
                           const std::vector<double>* moments) const {
    // Coefficients along the line of u, psi and their angular derivatives
    NodeValues line_u, line_u_z, line_psi, line_psi_z;
    for (unsigned int i = 0; i < n; ++i) {
      line_u[i] = line_u_z[i] = line_psi[i] = line_psi_z[i] = 0;
      for (unsigned int j = 0; j < n; ++j) {
        line_u[i] += angular.value[j] * u[i + n * j];
        line_u_z[i] += angular.derivative[j] * u[i + n * j];
        line_psi[i] += angular.value[j] * psi[i + n * j];
        line_psi_z[i] += angular.derivative[j] * psi[i + n * j];
      }
      line_u_z[i] *= per_length;
      line_psi[i] += length * angular.bubble * g[i];
      line_psi_z[i] = per_length * line_psi_z[i] + angular.mode * g[i];
    }
    if (kinks)
      kinks->add_to(angular.t, line_psi.data(), line_psi_z.data());
    const double correction_r = correction.value * per_height;
    double bound_squared = 0, norm_squared = 0, work_of_force = 0, work_of_rest = 0;
    for (unsigned int q = 0; q < radial->r.size(); ++q) {
      const double r = radial->r[q], alpha = radial->alpha[q], weight = radial->weight[q];
      const double xi = (r - low[0]) * per_height;
      double v_r = correction_r, v_z = correction.slope * xi;
      double psi_s = 0, psi_z = 0;
      const RadialShape* const shapes_at = &radial->shapes[n * q];
      for (unsigned int i = 0; i < n; ++i) {
        const RadialShape& shape = shapes_at[i];
        v_r += shape.derivative * line_u[i];
        v_z += shape.value * line_u_z[i];
        psi_s += shape.potential_s * line_psi[i];
        psi_z += shape.potential * line_psi_z[i];
      }
      const double moment = moments ? (*moments)[q] : 0;
      const double radial_flux = moment - psi_z; // r tau_r
      // tau_z = -alpha psi_s
      const double z_part = psi_s + v_z, r_part = radial_flux - r * v_r;
      bound_squared +=
          weight * r * alpha * z_part * z_part + radial->weight_over_r[q] * r_part * r_part;
      norm_squared += weight * r * (alpha * v_z * v_z + v_r * v_r);
      work_of_force += weight * moment * v_r;
      work_of_rest += weight * moment * correction_r;
    }
    return {bound_squared, norm_squared, work_of_force, work_of_rest};
  }

  const std::vector<double>& moments_of(const ForceColumn& column) {
    at_radii->integrals(column, moments);
    return moments;
  }

  const FieldVector& displacement;
  const FieldVector& potential;
  const AngularBubbles& bubbles;
  RadialShapesOfMesh& shapes;
  ForceColumns* columns;
  const ForceJumps& jumps;
  const unsigned int n;
  const std::vector<Polynomials::Polynomial<double>> lagrange;
  const Polynomials::Polynomial<double> beta;
  double unseen_share = 0; ///< int beta L dt, L the orthonormal Legendre polynomial of degree + 1
  LexicographicDofs dofs;
  std::vector<double> u, psi; ///< values at those of the cell
  std::vector<double> g;      ///< of the bubbles
  Point<2> low, high;
  double length = 0, per_length = 0, per_height = 0; ///< in z and in r
  const RadialShapes* radial = nullptr;
  const ForceLines* lines = nullptr; ///< of a force that is no number
  ForceAtRadii* at_radii = nullptr;
  std::optional<PotentialKinks> kinks;                ///< where there are any
  std::vector<double> moments;                        ///< G on a line
  const std::vector<double>* equal_moments = nullptr; ///< of a number
};

/// The ends of a piece of an edge, and those of panels in between.
std::vector<double> ends_of_parts(const FeasibleTrace::Piece& piece, const ForceLines* own) {
  std::vector<double> ends = {piece.t_begin};
  if (own)
    for (const double t : own->ends)
      if (piece.t_begin < t && t < piece.t_end)
        ends.push_back(t);
  ends.push_back(piece.t_end);
  return ends;
}

} // namespace

Certificate certify(const RingSpace& space, const Scene& scene, const ContactProblem& problem,
                    const ContactSolution& contact, const FieldVector& field, MeshSystem& system,
                    Work& work) {
  const Work::Phase phase(work, "certificate");
  const unsigned int degree = space.dof_handler().get_fe().degree;
  prepare_certificate(space, scene, system.stiffness.kind, system, work);
  DualParts& dual = *system.dual;
  const QGauss<1>& gauss = dual.gauss;
  const QGauss<1> along_road(degree + 6);
  ForceColumns* const columns = dual.columns ? &*dual.columns : nullptr;
  const bool is_uneven = dual.has_uneven_force();

  const FieldVector displacement = project_contact_nodes(space, problem, contact.active, field);
  const FeasibleTrace trace(space, scene, displacement, contact.active);
  const auto pressures = edge_pressures(space, scene, contact);
  const AffineConstraints<double> constraints =
      potential_constraints(space, scene, pressures, dual.jumps);
  const FieldVector potential = system.potential->solve(
      dual.shapes, constraints, is_uneven ? &dual.of_force->to_potential : nullptr, work);
  if (!system.is_kept)
    system.potential.reset();
  if (!system.bubbles)
    system.bubbles.emplace(space, dual.shapes);

  const auto& triangulation = space.dof_handler().get_triangulation();
  const AngularBubbles bubbles(space, scene, dual.shapes, potential, pressures,
                               is_uneven ? &dual.of_force->to_bubbles : nullptr, *system.bubbles);
  if (!system.is_kept)
    system.bubbles.reset();
  Integrator integrator(space, displacement, potential, bubbles, dual.shapes, columns, dual.jumps);
  const std::vector<AngularShapes> shapes_of_gauss = integrator.angular_shapes(gauss);
  IntervalMap<std::vector<AngularShapes>> own_shapes;
  std::vector<double> cell_bounds(triangulation.n_active_cells());
  Sums total;
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    integrator.reinit(cell);
    const double length = integrator.angular_length();
    LineIntegrals sums;
    double contact_work = 0;
    const auto face =
        integrator.ends_at(scene.outer_radius) ? space.surface_face(cell) : std::nullopt;
    const ForceLines* const own = integrator.own_lines();
    if (!face) {
      const Quadrature<1>& rule = own ? own->rule : gauss;
      const auto& lines = own ? own_shapes.at(cell->vertex(0)[1], cell->vertex(3)[1],
                                              [&] { return integrator.angular_shapes(rule); })
                              : shapes_of_gauss;
      for (unsigned int p = 0; p < rule.size(); ++p)
        sums.add(integrator.on_line(lines[p], {0, 0, 0}, integrator.moments_on(p)),
                 rule.weight(p) * length);
      if (!is_uneven)
        sums.bound_squared += integrator.unseen_square();
    } else
      for (const auto& piece : trace.pieces(*face)) {
        const std::vector<double> ends = ends_of_parts(piece, own);
        for (unsigned int part = 0; part + 1 < ends.size(); ++part)
          for (unsigned int p = 0; p < along_road.size(); ++p) {
            const double share = ends[part + 1] - ends[part];
            const double t = ends[part] + share * along_road.point(p)[0];
            const double weight = along_road.weight(p) * share * length;
            const auto correction = trace.correction(*face, piece, t);
            const AngularShapes angular = integrator.angular_shapes(t);
            const double pressure = pressures[*face](t) +
                                    integrator.surface_bubble() / scene.outer_radius * angular.mode;
            sums.add(integrator.on_line(angular, correction, integrator.moments_at(t)), weight);
            contact_work += weight * scene.outer_radius * pressure * correction.gap;
          }
      }
    sums.bound_squared += 2 * contact_work;
    cell_bounds[cell->active_cell_index()] = std::sqrt(std::max(sums.bound_squared, 0.));
    total.add(sums, 1);
  }
  const auto [bound_squared, norm_squared, work_of_force, work_of_rest] =
      sums_over(space.communicator(), total);

  double work_of_projection = 0; // on the contact nodes
  if (system.load) {
    FieldVector projection = displacement;
    projection -= field;
    work_of_projection = projection * *system.load;
  }

  const double of_flux = std::sqrt(std::max(bound_squared, 0.));
  double epsilon = 0, missed = 0;
  if (is_uneven) {
    epsilon = dual.interpolant->error();
    missed = dual.of_force->missed;
  }
  if (!system.is_kept)
    system.dual.reset();
  const double eta = of_flux + missed;
  const double energy_norm = epsilon + eta;
  const double energy = norm_squared / 2 - work_of_force;
  // Heights and moments are differences of radii.
  const double cancellation = scene.outer_radius / (scene.outer_radius - scene.inner_radius);
  const double round_off = 1e-15 * cancellation * (norm_squared + std::abs(work_of_force));
  const double energy_error = (epsilon + missed) * std::sqrt(norm_squared) + round_off;
  const double smallest_norm = std::sqrt(norm_squared) - energy_norm;
  double relative = std::numeric_limits<double>::infinity();
  if (smallest_norm > 0)
    relative = energy_norm / smallest_norm;
  else if (energy_norm == 0)
    relative = 0;
  return {{energy_norm, relative, energy - energy_error - eta * eta / 2 - epsilon * energy_norm,
           energy + energy_error, norm_squared},
          std::move(cell_bounds),
          trace,
          energy,
          work_of_rest + work_of_projection};
}

} // namespace rollwave
