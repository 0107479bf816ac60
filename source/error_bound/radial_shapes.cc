#include "rollwave/error_bound/radial_shapes.h"

#include "rollwave/mesh/graded_quadrature.h"
#include "rollwave/scene/scene.h"
#include <algorithm>
#include <boost/math/special_functions/legendre.hpp>
#include <cmath>
#include <deal.II/base/quadrature_lib.h>

namespace rollwave {

using namespace dealii;

namespace {

/// P_0(x), ..., P_(n-1)(x)
std::vector<double> legendre(unsigned int n, double x) {
  std::vector<double> p(n);
  for (unsigned int k = 0; k < n; ++k)
    p[k] = boost::math::legendre_p(k, x);
  return p;
}

} // namespace

StressFunctionBasis::StressFunctionBasis(const Scene& scene, unsigned int degree, double begin,
                                         double end)
    : scene(scene), degree(degree), begin(begin), end(end), length(1) {
  length = primitives(end)[1];
  const QGaussLobatto<1> nodes(degree + 1);
  FullMatrix<double> at_nodes(degree + 1);
  for (unsigned int k = 0; k <= degree; ++k) {
    const std::vector<double> row =
        primitives(k == degree ? end : begin + nodes.point(k)[0] * (end - begin));
    for (unsigned int j = 0; j <= degree; ++j)
      at_nodes(j, k) = row[j];
  }
  // sum_j c_ij primitive_j(r_k) = delta_ik
  coefficients.reinit(degree + 1, degree + 1);
  coefficients.invert(at_nodes);
}

std::vector<double> StressFunctionBasis::primitives(double r) const {
  // 1, then int_begin^r rho alpha P_j(x(rho)) drho over the depth of the interval. The only
  // singularity is at rho = 0, and the rule is exact to round-off. The integrand is of one sign but
  // for P_j: no difference of depths is taken, which would cancel in thin layers at the surface and
  // the critical speed.
  std::vector<double> result(degree + 1, 0.);
  result[0] = 1;
  if (!(r > begin))
    return result;
  static const QGauss<1> gauss(16);
  const RadialRule rule = graded_rule(begin, r, gauss);
  for (unsigned int q = 0; q < rule.r.size(); ++q) {
    const double rho = rule.r[q];
    const double weight = rule.weight[q] * rho * scene.alpha(rho) / length;
    const auto p = legendre(degree, 2 * (rho - begin) / (end - begin) - 1);
    for (unsigned int j = 0; j < degree; ++j)
      result[j + 1] += weight * p[j];
  }
  return result;
}

std::vector<double> StressFunctionBasis::values(double r) const {
  const std::vector<double> all = primitives(r);
  std::vector<double> result(degree + 1, 0.);
  for (unsigned int i = 0; i <= degree; ++i)
    for (unsigned int j = 0; j <= degree; ++j)
      result[i] += coefficients(i, j) * all[j];
  return result;
}

std::vector<double> StressFunctionBasis::depth_derivatives(double r) const {
  const auto p = legendre(degree, 2 * (r - begin) / (end - begin) - 1);
  std::vector<double> result(degree + 1, 0.);
  for (unsigned int i = 0; i <= degree; ++i)
    for (unsigned int j = 0; j < degree; ++j)
      result[i] -= coefficients(i, j + 1) * p[j] / length;
  return result;
}

namespace {

/// How many points leave an error of about 1e-13 in integrals of polynomials of degree 2 @p degree
/// over r. With the ratio q of the radii at the ends, 1/r is analytic in the ellipse around them
/// whose half-axes add up to rho = (sqrt(q) + 1)^2 / (q - 1) half lengths, and n points err by
/// rho^(2 degree - 2 n). Fewer would not do: without contact the bound is an equality.
unsigned int n_points(unsigned int degree, double ratio) {
  const double q = std::min(ratio, 2.); // graded_rule() cuts longer intervals
  const double rho = std::pow(std::sqrt(q) + 1, 2) / (q - 1);
  return degree + std::max(2., std::ceil(6.5 / std::log10(rho)));
}

} // namespace

void RadialShapes::integrate_over_r(const double* w, std::vector<double>& integrals) const {
  std::fill(integrals.begin(), integrals.end(), 0.);
  for (unsigned int q = 0; q < r.size(); ++q) {
    const double factor = w[q] * weight_over_r[q];
    const RadialShape* const shapes_at = &shapes[integrals.size() * q];
    for (unsigned int i = 0; i < integrals.size(); ++i)
      integrals[i] += factor * shapes_at[i].potential;
  }
}

RadialShapesOfMesh::RadialShapesOfMesh(const Scene& scene, unsigned int degree)
    : scene(scene), lagrange(lobatto_lagrange(degree)) {}

const RadialShapes& RadialShapesOfMesh::on(double begin, double end) {
  return known.at(begin, end, [&] { return make(begin, end); });
}

QGauss<1> RadialShapesOfMesh::gauss(double begin, double end) const {
  return QGauss<1>(n_points(lagrange.size() - 1, end / begin));
}

RadialShapes RadialShapesOfMesh::make(double begin, double end) const {
  const RadialRule rule = graded_rule(begin, end, gauss(begin, end));
  RadialShapes shapes;
  const StressFunctionBasis potential_shapes(scene, lagrange.size() - 1, begin, end);
  shapes.r = rule.r;
  shapes.weight = rule.weight;

  const unsigned int n_q = shapes.r.size(), n = lagrange.size();
  std::vector<double> both(2);
  for (unsigned int q = 0; q < n_q; ++q) {
    const double r = shapes.r[q];
    shapes.weight_over_r.push_back(shapes.weight[q] / r);
    shapes.alpha.push_back(scene.alpha(r));
    const std::vector<double> values = potential_shapes.values(r);
    const std::vector<double> derivatives = potential_shapes.depth_derivatives(r);
    for (unsigned int i = 0; i < n; ++i) {
      lagrange[i].value((r - begin) / (end - begin), both);
      shapes.shapes.push_back({both[0], both[1] / (end - begin), values[i], derivatives[i]});
    }
  }
  shapes.products = {FullMatrix<double>(n), FullMatrix<double>(n)};
  for (unsigned int q = 0; q < n_q; ++q)
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j) {
        const double r = shapes.r[q], weight = shapes.weight[q];
        const RadialShape &one = shapes.shapes[n * q + i], &other = shapes.shapes[n * q + j];
        shapes.products.stiffness(i, j) +=
            one.potential_s * other.potential_s * weight * r * shapes.alpha[q]; // ds = r alpha dr
        shapes.products.mass(i, j) += one.potential * other.potential * weight / r;
      }
  return shapes;
}

} // namespace rollwave
