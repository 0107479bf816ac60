#include "rollwave/error_bound/certificate_integrals.h"

#include "rollwave/mesh/line_elements.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

using Integrals = CertificateIntegrals;

/// Integrates over one cell after another.
class CellIntegrals {
public:
  CellIntegrals(const RingSpace& space, const Scene& scene, const AdmissibleFields& fields,
                const RadialShapesOfMesh& shapes)
      : space(space), scene(scene), fields(fields), shapes(shapes),
        n(space.dof_handler().get_fe().degree + 1), lagrange(lobatto_lagrange(n - 1)),
        rule(fields.force ? fields.force->rule() : QGauss<1>(n)),
        along_road(fields.trace.n_points()), dofs(space.dof_handler()), u(n * n), moved(n * n),
        psi(n * n), line_u(n), line_u_z(n), line_moved(n), line_moved_z(n), line_psi(n),
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
    if (fields.force)
      slopes = &slopes_on(*radial);
    const auto& of_cell = dofs.of(cell);
    for (unsigned int i = 0; i < of_cell.size(); ++i) {
      u[i] = fields.displacement(of_cell[i]);
      moved[i] = u[i] - fields.discrete(of_cell[i]);
      psi[i] = fields.stress_function(of_cell[i]);
    }
    const auto edge = space.surface_edge(cell);
    is_moved = edge || std::any_of(moved.begin(), moved.end(), [](double x) { return x != 0; });
    if (edge)
      return at_surface(*edge);
    Integrals sums;
    for (unsigned int p = 0; p < rule.size(); ++p)
      sums.add(on_line(rule.point(p)[0], lines[p], {0, 0, 0},
                       fields.force ? fields.force->on_line(number, p) : nullptr),
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
        Integrals here = on_line(t, angular, correction, fields.force ? line_q.data() : nullptr);
        const double pressure = scene.outer_radius * fields.pressures[edge](t);
        here.gap_work = 2 * pressure * correction.gap;
        here.bound_squared += here.gap_work;
        const double v = fields.trace.displacement(edge, piece, t);
        for (unsigned int k = 0; k < fields.load_functions.size(); ++k) {
          const double w = fields.load_functions[k].on_surface(low[1] + t * length);
          here.loads[k].trace = v * w;
          here.loads[k].pressure = pressure * w;
        }
        sums.add(here, weight);
      }
    return sums;
  }

  /// @param q_h values of Q_h at the radii of the cell; nullptr without force
  Integrals on_line(double t, const ShapesAtPoint& angular,
                    const AdmissibleTrace::Correction& correction, const double* q_h) {
    along(angular, u, line_u, line_u_z);
    along(angular, psi, line_psi, line_psi_z);
    if (is_moved)
      along(angular, moved, line_moved, line_moved_z);
    const double correction_r = correction.value / height;
    // A force that is a number does no vertical work.
    const unsigned int n_loads = !q_h ? 0 : fields.force->is_uniform() ? 1 : 2;
    std::array<double, 2> w = {};
    for (unsigned int k = 0; k < n_loads; ++k)
      w[k] = fields.load_functions[k].on_surface(low[1] + t * length);
    Integrals sums;
    for (unsigned int q = 0; q < radial->r.size(); ++q) {
      const double r = radial->r[q], alpha = radial->alpha[q], weight = radial->weight[q];
      const double correction_z = correction.slope * (r - low[0]) / height;
      double v_r = correction_r, v_z = correction_z;
      double psi_s = 0, psi_z = 0;
      for (unsigned int i = 0; i < n; ++i) {
        const RadialShape& shape = radial->shapes[n * q + i];
        v_r += shape.derivative * line_u[i];
        v_z += shape.value * line_u_z[i];
        psi_s += shape.psi_s * line_psi[i];
        psi_z += shape.psi * line_psi_z[i];
      }
      const double q_h_here = q_h ? q_h[q] : 0;
      const double z_part = psi_s + v_z;                // tau_z = -alpha psi_s
      const double r_part = q_h_here - psi_z - r * v_r; // r tau_r = Q_h - psi_z
      sums.bound_squared +=
          weight * r * alpha * z_part * z_part + radial->weight_over_r[q] * r_part * r_part;
      sums.norm_squared += weight * r * (alpha * v_z * v_z + v_r * v_r);
      sums.work_of_force += weight * q_h_here * v_r;
      for (unsigned int k = 0; k < n_loads; ++k)
        sums.loads[k].work_of_force += weight * q_h_here * (*slopes)[k][q] * w[k];
      const auto [w_r, w_z] =
          is_moved ? moved_slopes(q, correction_r, correction_z) : std::pair(0., 0.);
      sums.moved_squared += weight * r * (alpha * w_z * w_z + w_r * w_r);
      sums.discrete_squared += weight * r * alpha * (z_part - w_z) * (z_part - w_z) +
                               radial->weight_over_r[q] * (r_part + r * w_r) * (r_part + r * w_r);
    }
    return sums;
  }

  /// The values and z-derivatives along a line of a function with these nodal @p values.
  void along(const ShapesAtPoint& angular, const std::vector<double>& values,
             std::vector<double>& line, std::vector<double>& line_z) const {
    for (unsigned int i = 0; i < n; ++i) {
      line[i] = line_z[i] = 0;
      for (unsigned int j = 0; j < n; ++j) {
        line[i] += angular.value[j] * values[i + n * j];
        line_z[i] += angular.derivative[j] * values[i + n * j];
      }
      line_z[i] /= length;
    }
  }

  /// (w_r, w_z) of w = v - u_h, which has these derivatives beyond those of its nodal values.
  std::pair<double, double> moved_slopes(unsigned int q, double w_r, double w_z) const {
    for (unsigned int i = 0; i < n; ++i) {
      w_r += radial->shapes[n * q + i].derivative * line_moved[i];
      w_z += radial->shapes[n * q + i].value * line_moved_z[i];
    }
    return {w_r, w_z};
  }

  /// R' of both loads at the radii of a cell.
  const std::array<std::vector<double>, 2>& slopes_on(const RadialShapes& radial) {
    const auto [place, is_new] = known_slopes.try_emplace(&radial);
    for (unsigned int k = 0; is_new && k < fields.load_functions.size(); ++k)
      for (const double r : radial.r)
        place->second[k].push_back(fields.load_functions[k].radial_slope(r));
    return place->second;
  }

  const RingSpace& space;
  const Scene& scene;
  const AdmissibleFields& fields;
  const RadialShapesOfMesh& shapes;
  const unsigned int n;
  const std::vector<Polynomials::Polynomial<double>> lagrange;
  const QGauss<1> rule, along_road;
  std::vector<ShapesAtPoint> lines; ///< of the rule
  std::map<const RadialShapes*, std::array<std::vector<double>, 2>> known_slopes;
  LexicographicDofs dofs;
  std::vector<double> u, moved, psi; ///< values of v - c xi, the same minus u_h, and psi
  Point<2> low, high;
  double length = 0, height = 0;
  unsigned int number = 0; ///< of the active cell
  const RadialShapes* radial = nullptr;
  const std::array<std::vector<double>, 2>* slopes = nullptr;
  bool is_moved = false; ///< true if v may differ from u_h in the cell
  /// Values and z-derivatives along a line, and Q_h.
  std::vector<double> line_u, line_u_z, line_moved, line_moved_z, line_psi, line_psi_z, line_q;
};

} // namespace

CertificateIntegrals integrate_certificate(const RingSpace& space, const Scene& scene,
                                           const AdmissibleFields& fields,
                                           const RadialShapesOfMesh& shapes,
                                           std::vector<double>& cell_bounds) {
  CellIntegrals integrals(space, scene, fields, shapes);
  cell_bounds.assign(space.dof_handler().get_triangulation().n_active_cells(), 0.);
  CertificateIntegrals total;
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Integrals of_cell = integrals.over(cell);
    const unsigned int number = cell->active_cell_index();
    const double force_data = fields.force ? fields.force->cell_error_squared(number) : 0;
    cell_bounds[number] = std::sqrt(std::max(double(of_cell.bound_squared), 0.) + force_data);
    total.add(of_cell, 1);
  }
  for (long double* const sum : total.all())
    *sum = Utilities::MPI::sum(*sum, space.communicator());
  return total;
}

} // namespace rollwave
