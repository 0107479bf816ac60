#include "rollwave/error_bound/constitutive_error.h"

#include "rollwave/error_bound/angular_enrichment.h"
#include "rollwave/error_bound/dual_problem.h"
#include "rollwave/mesh/lexicographic_dofs.h"
#include "rollwave/mesh/tensor_elements.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// Shape functions in z at one point t = (z - begin)/(end - begin) of a cell.
struct AngularShapes {
  double t;
  std::vector<double> value, derivative; ///< the latter d/dt
  double bubble;                         ///< of AngularEnrichment: beta
  double mode;                           ///< P

  AngularShapes(const std::vector<Polynomials::Polynomial<double>>& lagrange,
                const Polynomials::Polynomial<double>& beta, double t)
      : t(t) {
    double both[2];
    for (const auto& polynomial : lagrange) {
      polynomial.value(t, 1, both);
      value.push_back(both[0]);
      derivative.push_back(both[1]);
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
  Number norm_squared = 0;
  Number work_of_force = 0;
  Number work_of_correction = 0;

  template <typename Other>
  void add(const Integrals<Other>& other, double weight) {
    bound_squared += weight * other.bound_squared;
    norm_squared += weight * other.norm_squared;
    work_of_force += weight * other.work_of_force;
    work_of_correction += weight * other.work_of_correction;
  }
};
using LineIntegrals = Integrals<double>;
using Sums = Integrals<long double>;

/// The integrands on one cell after another.
class Integrand {
public:
  Integrand(const RingSpace& space, const FieldVector& displacement, const FieldVector& potential,
            const AngularEnrichment& bubbles, DualProblem& dual)
      : displacement(displacement), potential(potential), bubbles(bubbles), dual(dual),
        n(space.dof_handler().get_fe().degree + 1), lagrange(lobatto_lagrange(n - 1)),
        beta(AngularEnrichment::mode(n - 1).primitive()), dofs(space.dof_handler()), u(n * n),
        psi(n * n), g(n), line_u(n), line_u_z(n), line_psi(n), line_psi_z(n) {
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
    height = high[0] - low[0];
    number = cell->active_cell_index();
    radial = &dual.shapes.on(low[0], high[0]);
    const auto& of_cell = dofs.of(cell);
    for (unsigned int i = 0; i < of_cell.size(); ++i) {
      u[i] = displacement(of_cell[i]);
      psi[i] = potential(of_cell[i]);
    }
    bubbles.values(of_cell, g);
  }

  /// On the line number @p p of the rule along z, where v = u_h.
  LineIntegrals on_line(const AngularShapes& angular, unsigned int p) {
    return on_line(angular, {0, 0, 0}, dual.force ? dual.force->on_line(number, p) : nullptr);
  }

  /// On any line, with the correction c of v on the surface.
  LineIntegrals on_line(const AngularShapes& angular,
                        const AdmissibleTrace::Correction& correction) {
    if (dual.force)
      dual.force->on_line_at(number, angular.t, moments);
    return on_line(angular, correction, dual.force ? moments.data() : nullptr);
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

  AngularShapes angular_shapes(double t) const { return AngularShapes(lagrange, beta, t); }

private:
  /// @param moments G_h at the radii of the cell; nullptr without force
  LineIntegrals on_line(const AngularShapes& angular, const AdmissibleTrace::Correction& correction,
                        const double* moments) {
    for (unsigned int i = 0; i < n; ++i) {
      line_u[i] = line_u_z[i] = line_psi[i] = line_psi_z[i] = 0;
      for (unsigned int j = 0; j < n; ++j) {
        line_u[i] += angular.value[j] * u[i + n * j];
        line_u_z[i] += angular.derivative[j] * u[i + n * j];
        line_psi[i] += angular.value[j] * psi[i + n * j];
        line_psi_z[i] += angular.derivative[j] * psi[i + n * j];
      }
      line_u_z[i] /= length;
      line_psi[i] += length * angular.bubble * g[i];
      line_psi_z[i] = line_psi_z[i] / length + angular.mode * g[i];
    }
    const double correction_r = correction.value / height;
    LineIntegrals sums;
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
      const double moment = moments ? moments[q] : 0;
      const double z_part = psi_s + v_z;              // tau_z = -alpha psi_s
      const double r_part = moment - psi_z - r * v_r; // r tau_r = G - psi_z
      sums.bound_squared +=
          weight * r * alpha * z_part * z_part + radial->weight_over_r[q] * r_part * r_part;
      sums.norm_squared += weight * r * (alpha * v_z * v_z + v_r * v_r);
      sums.work_of_force += weight * moment * v_r;
      sums.work_of_correction += weight * moment * correction_r;
    }
    return sums;
  }

  const FieldVector& displacement;
  const FieldVector& potential;
  const AngularEnrichment& bubbles;
  DualProblem& dual;
  const unsigned int n;
  const std::vector<Polynomials::Polynomial<double>> lagrange;
  const Polynomials::Polynomial<double> beta;
  double unseen_share = 0; ///< int beta L dt, L the orthonormal Legendre polynomial of degree + 1
  LexicographicDofs dofs;
  std::vector<double> u, psi; ///< values at those of the cell
  std::vector<double> g;      ///< of the bubbles
  Point<2> low, high;
  double length = 0, height = 0;
  unsigned int number = 0; ///< of the active cell
  const RadialShapes* radial = nullptr;
  /// Of u, psi and their angular derivatives along a line, and G_h there.
  std::vector<double> line_u, line_u_z, line_psi, line_psi_z, moments;
};

/// Over a cell with an edge on the surface, where v differs from u_h and the road's term is.
LineIntegrals integrate_at_surface(Integrand& integrand, const Scene& scene,
                                   const AdmissibleTrace& trace, unsigned int face,
                                   const EdgePressure& pressure, const QGauss<1>& along_road) {
  LineIntegrals sums;
  for (const auto& piece : trace.pieces(face))
    for (unsigned int p = 0; p < along_road.size(); ++p) {
      const double share = piece.t_end - piece.t_begin;
      const double t = piece.t_begin + share * along_road.point(p)[0];
      const double weight = along_road.weight(p) * share * integrand.angular_length();
      const auto correction = trace.correction(face, piece, t);
      const AngularShapes angular = integrand.angular_shapes(t);
      // b lambda
      const double moment =
          scene.outer_radius * pressure(t) + integrand.surface_bubble() * angular.mode;
      sums.add(integrand.on_line(angular, correction), weight);
      sums.bound_squared += 2 * weight * moment * correction.gap;
    }
  return sums;
}

} // namespace

ConstitutiveError integrate_constitutive_error(
    const RingSpace& space, const Scene& scene, const FieldVector& displacement,
    const AdmissibleTrace& trace, const std::vector<EdgePressure>& pressures,
    const FieldVector& potential, const AngularEnrichment& bubbles, DualProblem& dual) {
  const unsigned int degree = space.dof_handler().get_fe().degree;
  const QGauss<1> rule = angular_rule(scene, degree), along_road(degree + 6);
  Integrand integrand(space, displacement, potential, bubbles, dual);
  std::vector<AngularShapes> shapes;
  for (const auto& point : rule.get_points())
    shapes.push_back(integrand.angular_shapes(point[0]));

  std::vector<double> cell_bounds(space.dof_handler().get_triangulation().n_active_cells());
  Sums total;
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    integrand.reinit(cell);
    LineIntegrals sums;
    if (const auto face = space.surface_face(cell))
      sums = integrate_at_surface(integrand, scene, trace, *face, pressures[*face], along_road);
    else {
      for (unsigned int p = 0; p < rule.size(); ++p)
        sums.add(integrand.on_line(shapes[p], p), rule.weight(p) * integrand.angular_length());
      if (rule.size() == degree + 1)
        sums.bound_squared += integrand.unseen_square();
    }
    const unsigned int number = cell->active_cell_index();
    cell_bounds[number] = std::sqrt(std::max(sums.bound_squared, 0.) +
                                    (dual.force ? dual.force->cell_error_squared(number) : 0.));
    total.add(sums, 1);
  }
  std::vector<long double> sums = {total.bound_squared, total.norm_squared, total.work_of_force,
                                   total.work_of_correction};
  Utilities::MPI::sum(sums, space.communicator(), sums);
  return {double(sums[0]), double(sums[1]), double(sums[2]), double(sums[3]),
          std::move(cell_bounds)};
}

} // namespace rollwave
