#ifndef ROLLWAVE_INTERPOLATION_H
#define ROLLWAVE_INTERPOLATION_H

#include <deal.II/base/quadrature.h>
#include <deal.II/lac/full_matrix.h>

namespace rollwave {

/// The matrix that turns the values of a polynomial at the points of one rule into those at the
/// points of another, as many rows as the latter has.
dealii::FullMatrix<double> interpolation(const dealii::Quadrature<1>& from,
                                         const dealii::Quadrature<1>& to);

} // namespace rollwave

#endif
