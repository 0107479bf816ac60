#pragma once

#include "rollwave/solver/mumps_factor.h"
#include "rollwave/solver/sparse_factor.h"

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <memory>
#include <vector>

namespace rollwave {

/// A SystemMatrix on several processes: each has the rows of its degrees of freedom.
class DistributedMatrix : public SystemMatrix {
public:
  DistributedMatrix(const RingSpace& space, const dealii::AffineConstraints<double>& constraints,
                    const std::vector<SurfaceNode>& contact_nodes);

  void add(const std::vector<dealii::types::global_dof_index>& dofs,
           const dealii::FullMatrix<double>& cell_matrix) override;
  std::unique_ptr<const SparseFactor> factorise(RunStatistics& statistics) override;

private:
  const RingSpace& space;
  const dealii::AffineConstraints<double>& constraints;
  std::vector<int> contact_rows;
  std::unique_ptr<dealii::TrilinosWrappers::SparseMatrix> matrix;
};

/// A SparseFactor on several processes, by MUMPS.
class DistributedFactor : public SparseFactor {
public:
  DistributedFactor(const RingSpace& space, const std::vector<int>& contact_rows,
                    std::unique_ptr<const dealii::TrilinosWrappers::SparseMatrix> matrix,
                    std::unique_ptr<const MumpsFactor> factor);

  FieldVector solve(const FieldVector* rhs, const dealii::Vector<double>& contact_values,
                    RunStatistics& statistics) const override;
  FieldVector apply(const FieldVector& x) const override;
  dealii::FullMatrix<double> schur_factor() const override;

private:
  const RingSpace& space;
  const std::vector<int> contact_rows;
  const std::unique_ptr<const dealii::TrilinosWrappers::SparseMatrix> matrix;
  const std::unique_ptr<const MumpsFactor> factor;
  std::vector<int> n_owned, first_owned; ///< degrees of freedom of each process
};

} // namespace rollwave
