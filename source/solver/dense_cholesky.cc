#include "rollwave/solver/dense_cholesky.h"

#include "rollwave/base/errors.h"

#include <deal.II/lac/exceptions.h>

namespace rollwave {

using namespace dealii;

void factorise_dense(LAPACKFullMatrix<double>& matrix) {
  matrix.set_property(LAPACKSupport::symmetric);
  try {
    matrix.compute_cholesky_factorization();
  } catch (const LACExceptions::ExcSingular&) {
    throw NotSolved("the matrix of the contact nodes is not positive definite in floating-point "
                    "arithmetic; use cells that are less stretched");
  }
}

} // namespace rollwave
