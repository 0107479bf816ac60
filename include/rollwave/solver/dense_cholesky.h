#pragma once

#include <deal.II/lac/lapack_full_matrix.h>

namespace rollwave {

/// Replaces a symmetric matrix by its Cholesky factor, for LAPACKFullMatrix::solve().
/// @throws NotSolved where it is not positive definite in floating-point arithmetic
void factorise_dense(dealii::LAPACKFullMatrix<double>& matrix);

} // namespace rollwave
