#pragma once

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <mpi.h>

#include <vector>

namespace rollwave {

class RunStatistics;

/// Displacements and forces of contact nodes.
struct ContactState {
  dealii::Vector<double> displacement; ///< u_i, a length

  /// N_i = f_i - (K u)_i, a force: positive where the road presses. Over the node's weight it is
  /// the contact pressure.
  dealii::Vector<double> force;
};

/**
 * The dense problem that StiffnessFactor leaves on the contact nodes of a mesh,
 *
 *     S u = g - N.
 *
 * At each node either u_i (pinned) or N_i is given. All processes have all of it.
 */
class CondensedSystem {
public:
  /// @param schur_factor the lower triangular L with L L^T = S
  explicit CondensedSystem(const dealii::LAPACKFullMatrix<double>& schur_factor);
  CondensedSystem(const CondensedSystem&) = delete; // deal.II's copies forget that L is triangular
  CondensedSystem& operator=(const CondensedSystem&) = delete;

  unsigned int size() const { return schur.m(); }

  /// Sets N_i on the pinned nodes and u_i on the others. If some nodes are pinned and some are
  /// free, this needs a factorisation of the free block of S.
  /// @param g load, without entries for none
  /// @throws NotSolved where that block is not positive definite in rounded arithmetic
  void solve(const std::vector<bool>& pinned, const dealii::Vector<double>& g, ContactState& state,
             RunStatistics& statistics) const;

  /// S^-1 N
  dealii::Vector<double> apply_compliance(dealii::Vector<double> force) const;

private:
  dealii::LAPACKFullMatrix<double> factor; ///< L
  dealii::LAPACKFullMatrix<double> schur;  ///< S
};

/// Called by all processes before the dense problem of @p n_nodes contact nodes is made.
/// @throws NotEnoughMemory on all processes if they have less than it takes
void require_dense_memory(double n_nodes, MPI_Comm communicator);

} // namespace rollwave
