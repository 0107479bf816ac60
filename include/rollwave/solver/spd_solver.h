#pragma once

#include "rollwave/base/run_statistics.h"
#include "rollwave/mesh/assembly.h"

namespace rollwave {

/// Linear problems with one symmetric positive definite matrix on a space, for the degrees of
/// freedom that constraints leave.
class SpdSolver {
public:
  virtual ~SpdSolver() = default;

  /// Sets up for the sum of the @p matrices of cells. Later calls must have the same
  /// @p constraints except for their inhomogeneities.
  /// @throws NotEnoughMemory, or NotSolved where the sum is not positive definite
  virtual void set_matrix(const dealii::AffineConstraints<double>& constraints,
                          const CellMatrices& matrices, RunStatistics& statistics) = 0;

  /// The solution for @p rhs, which obeys homogeneous constraints; zero where a constraint holds.
  virtual FieldVector solve(const FieldVector& rhs, RunStatistics& statistics) = 0;
};

} // namespace rollwave
