#include "rollwave/error_bound/radial_shapes.h"

#include "rollwave/mesh/line_elements.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace rollwave {

using namespace dealii;

StressFunctionBasis::StressFunctionBasis(const Scene& scene, unsigned int degree, double begin,
                                         double end)
    : scene(scene), begin(begin), end(end), depth(1),
      modes(Polynomials::Legendre::generate_complete_basis(degree - 1)), coefficients(degree + 1) {
  depth = primitives(end)[1];
  const QGaussLobatto<1> nodes(degree + 1);
  FullMatrix<double> at_nodes(degree + 1);
  for (unsigned int k = 0; k <= degree; ++k) {
    const Vector<double> row =
        primitives(k == degree ? end : begin + nodes.point(k)[0] * (end - begin));
    for (unsigned int j = 0; j <= degree; ++j)
      at_nodes(j, k) = row[j];
  }
  coefficients.invert(at_nodes); // sum_j c_ij primitive_j(r_k) = delta_ik
}

Vector<double> StressFunctionBasis::primitives(double r) const {
  // 1, then int_begin^r rho alpha P_j drho over the depth of the interval. The only singularity is
  // at rho = 0, and the rule is exact to round-off. The integrand is of one sign except for P_j: a
  // difference of depths would cancel in thin layers at the surface and the critical speed.
  Vector<double> result(modes.size() + 1);
  result[0] = 1;
  if (!(r > begin))
    return result;
  static const QGauss<1> gauss(16);
  const RadialRule rule = graded_rule(begin, r, gauss);
  for (unsigned int q = 0; q < rule.r.size(); ++q) {
    const double rho = rule.r[q], weight = rule.weight[q] * rho * scene.alpha(rho) / depth;
    for (unsigned int j = 0; j < modes.size(); ++j)
      result[j + 1] += weight * modes[j].value((rho - begin) / (end - begin));
  }
  return result;
}

Vector<double> StressFunctionBasis::values(double r) const {
  Vector<double> result(coefficients.m());
  coefficients.vmult(result, primitives(r));
  return result;
}

Vector<double> StressFunctionBasis::depth_derivatives(double r) const {
  Vector<double> of_primitives(coefficients.m()), result(coefficients.m());
  for (unsigned int j = 0; j < modes.size(); ++j)
    of_primitives[j + 1] = -modes[j].value((r - begin) / (end - begin)) / depth;
  coefficients.vmult(result, of_primitives);
  return result;
}

void RadialShapes::integrate(const double* w, const std::vector<double>& weights,
                             double RadialShape::*function, std::vector<double>& integrals) const {
  std::fill(integrals.begin(), integrals.end(), 0.);
  for (unsigned int q = 0; q < r.size(); ++q)
    for (unsigned int i = 0; i < integrals.size(); ++i)
      integrals[i] += w[q] * weights[q] * (shapes[integrals.size() * q + i].*function);
}

double missed_between_points(const RadialShapes& radial, const double* line) {
  const auto& highest = radial.highest_mode;
  double sum = 0;
  for (unsigned int piece = 0; piece < radial.r.size(); piece += highest.size()) {
    double measure = 0, coefficient = 0;
    for (unsigned int q = 0; q < highest.size(); ++q) {
      measure += radial.weight_over_r[piece + q];
      coefficient += highest[q] * line[piece + q];
    }
    sum += measure * highest.size() * coefficient * coefficient;
  }
  return sum;
}

namespace {

RadialShapes make_shapes(const Scene& scene,
                         const std::vector<Polynomials::Polynomial<double>>& lagrange, double begin,
                         double end) {
  const QGauss<1> points(points_for_pole(begin, end, lagrange.size() - 1));
  const RadialRule rule = graded_rule(begin, end, points);
  RadialShapes shapes;
  const StressFunctionBasis basis(scene, lagrange.size() - 1, begin, end);
  shapes.r = rule.r;
  shapes.weight = rule.weight;

  const unsigned int n_q = shapes.r.size(), n = lagrange.size();
  for (unsigned int q = 0; q < n_q; ++q) {
    const double r = shapes.r[q];
    shapes.weight_over_r.push_back(shapes.weight[q] / r);
    shapes.alpha.push_back(scene.alpha(r));
    const Vector<double> values = basis.values(r);
    const Vector<double> derivatives = basis.depth_derivatives(r);
    const ShapesAtPoint displacements(lagrange, (r - begin) / (end - begin));
    for (unsigned int i = 0; i < n; ++i)
      shapes.shapes.push_back({displacements.value[i], displacements.derivative[i] / (end - begin),
                               values[i], derivatives[i]});
  }
  const Polynomials::Legendre highest(points.size() - 1);
  for (unsigned int q = 0; q < points.size(); ++q)
    shapes.highest_mode.push_back(points.weight(q) * highest.value(points.point(q)[0]));
  shapes.products = {FullMatrix<double>(n), FullMatrix<double>(n)};
  for (unsigned int q = 0; q < n_q; ++q)
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j) {
        const double r = shapes.r[q], weight = shapes.weight[q];
        const RadialShape &one = shapes.shapes[n * q + i], &other = shapes.shapes[n * q + j];
        shapes.products.stiffness(i, j) +=
            one.psi_s * other.psi_s * weight * r * shapes.alpha[q]; // ds = r alpha dr
        shapes.products.mass(i, j) += one.psi * other.psi * shapes.weight_over_r[q];
      }
  return shapes;
}

} // namespace

RadialShapesOfMesh::RadialShapesOfMesh(const RingSpace& space, const Scene& scene) {
  const auto lagrange = lobatto_lagrange(space.dof_handler().get_fe().degree);
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const double begin = cell->vertex(0)[0], end = cell->vertex(3)[0];
    const auto [place, is_new] = of_interval.try_emplace({begin, end});
    if (is_new)
      place->second = make_shapes(scene, lagrange, begin, end);
  }
}

} // namespace rollwave
