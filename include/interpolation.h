#ifndef ROLLWAVE_INTERPOLATION_H
#define ROLLWAVE_INTERPOLATION_H

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/full_matrix.h>

namespace rollwave {

/// The matrix that turns the values of a polynomial at the points of one rule into those at the
/// points of another, as many rows as the latter has.
dealii::FullMatrix<double> interpolation(const dealii::Quadrature<1>& from,
                                         const dealii::Quadrature<1>& to);

/// A rule, and a finer one, which tells what the rule misses.
struct FinerRule {
  FinerRule(const dealii::QGauss<1>& rule, const dealii::Quadrature<1>& fine);

  const dealii::QGauss<1> rule;
  const dealii::Quadrature<1> fine;
  const dealii::FullMatrix<double> interpolation; ///< from the rule to the fine one
};

} // namespace rollwave

#endif
