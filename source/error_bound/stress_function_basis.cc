#include "rollwave/error_bound/stress_function_basis.h"

#include "rollwave/mesh/graded_quadrature.h"
#include "rollwave/scene/scene.h"

#include <boost/math/special_functions/legendre.hpp>
#include <deal.II/base/quadrature_lib.h>

#include <cmath>

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

} // namespace rollwave
