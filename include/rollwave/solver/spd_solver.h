#ifndef ROLLWAVE_SOLVER_SPD_SOLVER_H
#define ROLLWAVE_SOLVER_SPD_SOLVER_H

#include "rollwave/base/run_statistics.h"
#include "rollwave/mesh/assembly.h"

namespace rollwave {

/// Linear problems with one symmetric positive definite matrix on a space, for the degrees of
/// freedom that constraints leave.
class SpdSolver {
public:
  virtual ~SpdSolver() = default;

  /// Takes the matrix of a form by its radial integrals, those of stiffness_products() or of the
  /// dual form, in which couplings are as strong. Later calls must have the same @p constraints but
  /// for their inhomogeneities.
  /// @throws NotEnoughMemory, or NotSolved where the sum is not positive definite
  virtual void set_matrix(const dealii::AffineConstraints<double>& constraints,
                          const RadialProducts& radial, RunStatistics& statistics) = 0;

  /// The solution for @p rhs, which obeys homogeneous constraints; zero where a constraint holds.
  virtual FieldVector solve(const FieldVector& rhs, RunStatistics& statistics) = 0;
};

} // namespace rollwave

#endif
