#include "bound_integrals.h"

#include "angular_bubbles.h"
#include "constant_size.h"
#include "force_columns.h"
#include "force_integrals.h"
#include "interval_map.h"
#include "lexicographic_dofs.h"
#include "mesh_system.h"
#include "parameters.h"
#include "potential_kinks.h"
#include "radial_shapes.h"
#include "scene.h"
#include "shape_products.h"
#include "task_beside.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

using IntegratedCell = DoFHandler<2>::active_cell_iterator;

/// At the nodes on one side of a cell.
using LineValues = std::array<double, highest_degree + 1>;

/// Shape functions in z at one point t = (z - begin)/(end - begin) of a cell.
struct AngularShapes {
  double t;
  LineValues value, derivative; ///< the latter d/dt
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

class Integrator {
public:
  Integrator(const RingSpace& space, const FieldVector& displacement, const FieldVector& potential,
             const AngularBubbles& bubbles, const DualParts& dual)
      : displacement(displacement), potential(potential), bubbles(bubbles), dual(dual),
        columns(dual.columns ? &*dual.columns : nullptr),
        n(space.dof_handler().get_fe().degree + 1), lagrange(lobatto_lagrange(n - 1)),
        beta(AngularBubbles::mode(n - 1).primitive()), dofs(space.dof_handler()), u(n * n),
        psi(n * n), g(n) {
    const Polynomials::Legendre highest(n);
    const QGauss<1> gauss(n + 1);
    for (unsigned int q = 0; q < gauss.size(); ++q) {
      const double t = gauss.point(q)[0];
      unseen_share += gauss.weight(q) * highest.value(t) * beta.value(t);
    }
  }

  void reinit(const IntegratedCell& cell) {
    low = cell->vertex(0);
    high = cell->vertex(3);
    length = high[1] - low[1];
    per_length = 1 / length;
    per_height = 1 / (high[0] - low[0]);
    radial = &dual.shapes.made_on(low[0], high[0]);
    const auto& of_cell = dofs.of(cell);
    for (unsigned int i = 0; i < of_cell.size(); ++i) {
      u[i] = displacement(of_cell[i]);
      psi[i] = potential(of_cell[i]);
    }
    bubbles.values(of_cell, g);
    if (!columns)
      return;
    if (columns->has_equal_lines())
      equal_moments = &known_moments.at(low[0], high[0], [&] {
        std::vector<double> on_any_line;
        ForceAtRadii(radial->r).integrals(columns->at(0, low[0]), on_any_line);
        return on_any_line;
      });
    else {
      lines = &columns->made_on(low[1], high[1]);
      at_radii = &known_radii.at(low[0], high[0], [&] { return ForceAtRadii(radial->r); });
      kinks = kinks_of_cell(dual.jumps, low, high, n - 1);
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
    LineValues line_u, line_u_z, line_psi, line_psi_z;
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
  const DualParts& dual;
  const ForceColumns* const columns;
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
  IntervalMap<ForceAtRadii> known_radii;
  IntervalMap<std::vector<double>> known_moments;
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

/// The integrals over the own cells from @p begin to @p end.
Sums integrate_cells(const RingSpace& space, const Scene& scene, const FeasibleTrace& trace,
                     const std::vector<EdgePressure>& pressures, const DualParts& dual,
                     Integrator integrator, const IntegratedCell& begin, const IntegratedCell& end,
                     std::vector<double>& cell_bounds) {
  const unsigned int degree = space.dof_handler().get_fe().degree;
  const QGauss<1>& gauss = dual.gauss;
  const QGauss<1> along_road(degree + 6);
  const std::vector<AngularShapes> shapes_of_gauss = integrator.angular_shapes(gauss);
  IntervalMap<std::vector<AngularShapes>> own_shapes;
  Sums total;
  for (IntegratedCell cell = begin; cell != end; ++cell) {
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
      if (!dual.has_uneven_force())
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
  return total;
}

} // namespace

BoundIntegrals integrate_bound(const RingSpace& space, const Scene& scene,
                               const FieldVector& displacement, const FeasibleTrace& trace,
                               const std::vector<EdgePressure>& pressures,
                               const FieldVector& potential, const AngularBubbles& bubbles,
                               const DualParts& dual) {
  const DoFHandler<2>& handler = space.dof_handler();
  const unsigned int n_cells = handler.get_triangulation().n_active_cells();
  std::vector<double> cell_bounds(n_cells);
  IntegratedCell middle = handler.begin_active();
  std::advance(middle, n_cells / 2);
  const auto integrate = [&](const IntegratedCell& begin, const IntegratedCell& end) {
    return integrate_cells(space, scene, trace, pressures, dual,
                           Integrator(space, displacement, potential, bubbles, dual), begin, end,
                           cell_bounds);
  };
  // Which take a fifth of a millisecond or more, beside which a thread's start does not count.
  constexpr unsigned int few_cells = 1000;
  Sums of_second_half;
  TaskBeside second_half(n_cells > few_cells && gains_by_threads(),
                         [&] { of_second_half = integrate(middle, handler.end()); });
  Sums total = integrate(handler.begin_active(), middle);
  second_half.finish();
  total.add(of_second_half, 1);
  std::vector<long double> sums = {total.bound_squared, total.norm_squared, total.work_of_force,
                                   total.work_of_rest};
  Utilities::MPI::sum(sums, space.communicator(), sums);
  return {double(sums[0]), double(sums[1]), double(sums[2]), double(sums[3]),
          std::move(cell_bounds)};
}

} // namespace rollwave
