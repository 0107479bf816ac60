#pragma once

#include "rollwave/solver/cholmod_factor.h"
#include "rollwave/solver/spd_solver.h"

#include <vector>

namespace rollwave {

/// A sparse Cholesky factorisation, on one process. The unknowns are numbered in the order of
/// elimination of the space; the analysis is kept.
class SparseCholesky : public SpdSolver {
public:
  /// @param last nodes, none of them constrained, to be eliminated last, in this order
  explicit SparseCholesky(const RingSpace& space, const std::vector<SurfaceNode>& last = {})
      : space(space), last(last) {}

  void set_matrix(const dealii::AffineConstraints<double>& constraints,
                  const CellMatrices& matrices, RunStatistics& statistics) override;
  FieldVector solve(const FieldVector& rhs, RunStatistics& statistics) override;

  // set_matrix() in its steps; the first one does nothing when it is repeated:
  void number_unknowns(const dealii::AffineConstraints<double>& constraints);
  LowerTriplets assemble(const dealii::AffineConstraints<double>& constraints,
                         const CellMatrices& matrices) const;
  void analyse(const LowerTriplets& triplets, RunStatistics& statistics);
  void factorise(RunStatistics& statistics);

  CholmodFactor& factor() { return *cholesky; }
  const CholmodFactor& factor() const { return *cholesky; }

  /// The values of a field at the unknowns.
  std::vector<double> gather(const FieldVector& field) const;

  /// The field with these values at the unknowns, zero where a constraint holds.
  FieldVector scatter(const std::vector<double>& unknowns) const;

private:
  const RingSpace& space;
  const std::vector<SurfaceNode> last;
  std::vector<int> unknown_of_dof; ///< -1 where a constraint holds
  std::unique_ptr<CholmodFactor> cholesky;
};

} // namespace rollwave
