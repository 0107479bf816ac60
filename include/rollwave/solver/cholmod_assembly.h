#ifndef ROLLWAVE_SOLVER_CHOLMOD_ASSEMBLY_H
#define ROLLWAVE_SOLVER_CHOLMOD_ASSEMBLY_H

#include "rollwave/mesh/ring_space.h"
#include "rollwave/solver/cholmod_factor.h"

#include <vector>

namespace rollwave {

struct Scene;

/// The number of each degree of freedom among the unknowns, in the order of elimination but with
/// the contact nodes last, those first where the road is farthest from the cylinder; -1 where a
/// constraint holds.
std::vector<int> number_unknowns(const RingSpace& space, const Scene& scene);

/// Adds up cell matrices to a matrix of the unknowns: constrained degrees of freedom are replaced
/// by the combination of unknowns that their constraint names.
class TripletAssembler {
public:
  /// @p unknown_of_dof is as number_unknowns() returns it.
  TripletAssembler(const RingSpace& space, const dealii::AffineConstraints<double>& constraints,
                   const std::vector<int>& unknown_of_dof);

  /// @p cell_matrix is symmetric.
  void add(const std::vector<dealii::types::global_dof_index>& dofs,
           const dealii::FullMatrix<double>& cell_matrix);

  LowerTriplets triplets;

private:
  const dealii::AffineConstraints<double>& constraints;
  const std::vector<int>& unknown_of_dof;
  std::vector<int> unknowns; ///< of the cell's degrees of freedom
  std::vector<std::vector<std::pair<int, double>>> expansion;
};

/// The stiffness matrix of the unknowns.
LowerTriplets assemble_triplets(const RingSpace& space, const Scene& scene,
                                const std::vector<int>& unknown_of_dof);

} // namespace rollwave

#endif
