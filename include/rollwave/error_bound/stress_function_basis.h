#ifndef ROLLWAVE_ERROR_BOUND_STRESS_FUNCTION_BASIS_H
#define ROLLWAVE_ERROR_BOUND_STRESS_FUNCTION_BASIS_H

#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace rollwave {

struct Scene;

/**
 * The radial shape functions of a potential psi on the interval [begin, end] of a cell: functions
 * whose derivative by the depth s(r) = int_r^b rho alpha drho is a polynomial of degree p - 1 in r,
 *
 *     psi(r) = c + int_begin^r rho alpha q(rho) drho,   psi_s = -q,
 *
 * since psi_s stands for the derivative u_z of a displacement that is smooth in r. In s itself psi
 * is smooth only below the critical speed, and polynomials in s would approximate it worse near the
 * surface. Shape function i is 1 at the i-th Gauss-Lobatto point of the interval and 0 at the
 * others. Restricted to a part of the interval, the functions are those of the part.
 */
class StressFunctionBasis {
public:
  StressFunctionBasis(const Scene& scene, unsigned int degree, double begin, double end);

  std::vector<double> values(double r) const;
  std::vector<double> depth_derivatives(double r) const; ///< d/ds

  /// s(begin) - s(end)
  double depth() const { return length; }

private:
  std::vector<double> primitives(double r) const;

  const Scene& scene;
  unsigned int degree;
  double begin, end, length;
  dealii::FullMatrix<double> coefficients; ///< (i, j) of shape i over primitive j
};

} // namespace rollwave

#endif
