#ifndef ROLLWAVE_SYMMETRIC_SOLVER_H
#define ROLLWAVE_SYMMETRIC_SOLVER_H

#include "assembly.h"
#include "parameters.h"
#include "work.h"

#include <memory>

namespace rollwave {

struct Scene;

/// Hands the matrices of all cells of this process to its argument.
using EachCellMatrix = std::function<void(const AddCellMatrix& add)>;

/// Linear problems with one symmetric positive definite matrix on a space, for the degrees of
/// freedom that constraints leave.
class SymmetricSolver {
public:
  virtual ~SymmetricSolver() = default;

  /// Takes the sum of all cell matrices, those of int r (alpha d_z v d_z w + d_r v d_r w) dr dz or
  /// of the dual form, in which couplings are as strong. Later calls must have the same @p
  /// constraints but for their inhomogeneities.
  /// @throws NotEnoughMemory, or NotSolved where the sum is not positive definite
  virtual void set_matrix(const Scene& scene, const dealii::AffineConstraints<double>& constraints,
                          const EachCellMatrix& each, Work& work) = 0;

  /// The solution for @p rhs and, unless it is nullptr, a @p lasting one added, which is prepared
  /// once for calls that have it in common. Both obey homogeneous constraints; the solution is zero
  /// where a constraint holds.
  virtual FieldVector solve(const FieldVector& rhs, const FieldVector* lasting, Work& work) = 0;
};

/// @p kind is direct or iterative.
std::unique_ptr<SymmetricSolver> make_symmetric_solver(SolverKind kind, const RingSpace& space);

} // namespace rollwave

#endif
