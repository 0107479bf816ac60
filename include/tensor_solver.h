#ifndef ROLLWAVE_TENSOR_SOLVER_H
#define ROLLWAVE_TENSOR_SOLVER_H

#include "banded_matrix.h"
#include "symmetric_solver.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <vector>

namespace rollwave {

/**
 * By fast diagonalisation (R. E. Lynch, J. R. Rice and D. H. Thomas, Numer. Math. 6 (1964)
 * 185-199), on one process and a mesh of complete rows and columns of cells, where nodes are
 * constrained as those of another angle are. With the radial integrals S and P of RadialProducts
 * (stiffness and mass), the angular ones K and M likewise, and
 *
 *     S V = P V Lambda,   V^T P V = I,
 *
 * the matrix and its inverse are
 *
 *     A = S x M + P x K,   A^-1 = (V x I) (Lambda x M + I x K)^-1 (V^T x I):
 *
 * one banded problem around the ring for each radial mode, and no factor that fills in.
 */
class TensorSolver : public SymmetricSolver {
public:
  explicit TensorSolver(const RingSpace& space) : space(space) {}

  /// Whether a space on one process has such a mesh, and one where this takes less time than a
  /// sparse factorisation.
  static bool suits(const RingSpace& space);

  void set_matrix(const Scene& scene, const dealii::AffineConstraints<double>& constraints,
                  const RadialProducts& radial, Work& work) override;
  FieldVector solve(const FieldVector& rhs, Work& work) override;

private:
  const RingSpace& space;
  unsigned int n_angles = 0; ///< of nodes

  /// Those that are free: of one radial node after another, in the order of the angular matrices.
  std::vector<dealii::types::global_dof_index> dofs;

  BandedMatrix angular_mass{0}, angular_stiffness{0}; ///< M, K
  std::vector<double> eigenvalues;                    ///< Lambda
  dealii::LAPACKFullMatrix<double> modes;             ///< V
};

} // namespace rollwave

#endif
