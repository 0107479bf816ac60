#include "rollwave/error_bound/angular_enrichment.h"

#include "rollwave/error_bound/enrichment_columns.h"
#include "rollwave/mesh/lexicographic_dofs.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// What is nearest to @p wanted among the m with lambda + m P >= 0 for sure: coefficients over
/// Bernstein's polynomials B_k are positive, those of P are (-1)^(p + k) binomial(p, k) (2 p +
/// 1)^(1/2), those of lambda lie on a line. There are such m for all that admissible_pressures()
/// returns.
double nearest_mode(const EdgePressure& pressure, unsigned int degree, double wanted) {
  double nearest = wanted, binomial = 1;
  for (unsigned int k = 0; k <= degree; ++k) {
    const double of_mode = (degree + k) % 2 ? -binomial * std::sqrt(2 * degree + 1.)
                                            : binomial * std::sqrt(2 * degree + 1.);
    const double limit = pressure(1. * k / degree) / -of_mode;
    nearest = of_mode < 0 ? std::min(nearest, limit) : std::max(nearest, limit);
    binomial *= 1. * (degree - k) / (k + 1);
  }
  return nearest;
}

/// Integrals over t of the polynomials of a degree, by Gauss' rule.
struct AngularIntegrals {
  explicit AngularIntegrals(unsigned int degree) : gauss(degree + 2), bubble_of(degree + 1) {
    const auto mode = AngularEnrichment::mode(degree), bubble = mode.primitive();
    const auto lagrange = lobatto_lagrange(degree);
    for (unsigned int q = 0; q < gauss.size(); ++q) {
      const double t = gauss.point(q)[0], weight = gauss.weight(q);
      weighted_mode.push_back(weight * mode.value(t));
      for (unsigned int j = 0; j <= degree; ++j)
        bubble_of[j] += weight * bubble.value(t) * lagrange[j].value(t);
    }
  }

  QGauss<1> gauss;
  std::vector<double> weighted_mode; ///< P at the points, times their weights
  std::vector<double> bubble_of;     ///< int beta L_j dt
};

/// The load of D(tau) as a function of g in the rows of columns, where they are not fixed.
std::vector<double> assemble_load(const RingSpace& space, const Scene& scene,
                                  RadialShapesOfMesh& shapes, const FieldVector& potential,
                                  const std::vector<EdgePressure>& pressures,
                                  const ForceIntegral* force, const EnrichmentColumns& columns) {
  const unsigned int degree = space.dof_handler().get_fe().degree, n = degree + 1;
  const AngularIntegrals integrals(degree);
  LexicographicDofs dofs(space.dof_handler());
  const auto mode = AngularEnrichment::mode(degree);
  std::vector<double> psi_bubble(n), force_on_line(n);
  std::vector<double> load_of_row(columns.form.size());
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    const double length = high[1] - low[1];
    const RadialShapes& radial = shapes.on(low[0], high[0]);
    double* const load = &load_of_row[columns.first_rows[cell->active_cell_index()]];
    const auto& of_cell = dofs.of(cell);
    for (unsigned int i = 0; i < n; ++i) {
      psi_bubble[i] = 0;
      for (unsigned int j = 0; j < n; ++j)
        psi_bubble[i] += integrals.bubble_of[j] * potential(of_cell[i + n * j]);
    }
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int k = 0; k < n; ++k)
        load[i] -= length * length * radial.products.stiffness(i, k) * psi_bubble[k];
    for (unsigned int p = 0; force && p < force->rule().size(); ++p) {
      radial.integrate_over_r(force->on_line(cell->active_cell_index(), p), force_on_line);
      const double weight =
          length * force->rule().weight(p) * mode.value(force->rule().point(p)[0]);
      for (unsigned int i = 0; i < n; ++i)
        load[i] += weight * force_on_line[i];
    }
  }
  for (const auto& [row, edge] : columns.surface_rows) {
    if (!(pressures[edge].mean > 0))
      continue;
    const SurfaceFace& face = space.surface_faces()[edge];
    const double length = face.end - face.begin;
    for (unsigned int p = 0; p < integrals.gauss.size(); ++p)
      load_of_row[row] -= length * integrals.weighted_mode[p] *
                          scene.road(face.begin + integrals.gauss.point(p)[0] * length);
  }
  return load_of_row;
}

} // namespace

Polynomials::Polynomial<double> AngularEnrichment::mode(unsigned int degree) {
  return Polynomials::Legendre(degree);
}

AngularEnrichment::AngularEnrichment(const RingSpace& space, const Scene& scene,
                                     RadialShapesOfMesh& shapes, const FieldVector& potential,
                                     const std::vector<EdgePressure>& pressures,
                                     const ForceIntegral* force, const EnrichmentColumns& columns)
    : n(space.dof_handler().get_fe().degree + 1), field(space.make_field()) {
  ColumnForm form = columns.form;
  std::vector<double> load_of_row =
      assemble_load(space, scene, shapes, potential, pressures, force, columns);
  std::vector<EnrichmentColumns::SurfaceRow> free_rows; // where pressures can change
  for (const auto& surface_row : columns.surface_rows)
    if (pressures[surface_row.edge].mean > 0)
      free_rows.push_back(surface_row);
    else {
      form.fix(surface_row.row);
      load_of_row[surface_row.row] = 0;
    }
  for (const unsigned int row : columns.fixed_rows)
    load_of_row[row] = 0;
  const FieldVector load = form.add_up(load_of_row);
  field = form.solve(load);

  // Of a convex function of each column the least with a bound of one value has that value at the
  // bound, and the rest as is best then.
  const std::vector<double> g = form.rows_of(field);
  std::vector<double> change(g.size());
  std::vector<unsigned int> changed_rows;
  const double b = scene.outer_radius;
  for (const auto& [row, edge] : free_rows) {
    change[row] = b * nearest_mode(pressures[edge], n - 1, g[row] / b) - g[row];
    changed_rows.push_back(row);
  }
  field += form.follow(std::move(change), changed_rows);
  field.update_ghost_values();
}

void AngularEnrichment::values(const std::vector<types::global_dof_index>& dofs,
                               std::vector<double>& g) const {
  for (unsigned int i = 0; i < n; ++i)
    g[i] = field(dofs[bubble_carrier(i, n)]);
}

} // namespace rollwave
