#pragma once

#include "rollwave/solver/elimination_order.h"

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <mpi.h>

#include <memory>
#include <vector>

namespace rollwave {

class InterfaceSolver;
class SparseFactor;

/**
 * The linear system that the SparseFactors leave on the unknowns that the processes keep,
 *
 *     S u = r,     S = sum S_p,     r = sum r_p.
 *
 * Values are given at some of them, and each process has S_p and r_p. By LAPACK it eliminates the
 * unknowns F that it has alone and that are not given, which leaves on the interface g
 *
 *     T_p = S_gg - S_gF S_FF^-1 S_Fg,
 *
 * whose sum is the matrix of an InterfaceSolver. On one process there is no interface.
 */
class CondensedSystem {
public:
  /// All processes must call it. @throws NotEnoughMemory, NotSolved
  CondensedSystem(const SparseFactor& factor, MPI_Comm communicator);

  /// The system of one process with S = L L^T. @param factor L, lower triangular
  explicit CondensedSystem(const dealii::LAPACKFullMatrix<double>& factor);

  ~CondensedSystem();
  CondensedSystem(const CondensedSystem&) = delete;
  CondensedSystem& operator=(const CondensedSystem&) = delete;

  const KeptUnknowns& kept() const { return unknowns; }
  MPI_Comm communicator() const { return processes; }

  /// Sets u where it is not given. All processes must call it. It keeps the factor of the unknowns
  /// given last, so that further right-hand sides need no other.
  /// @param load r_p @return false where the same unknowns were given last
  /// @throws NotSolved where the matrix is not positive definite in rounded arithmetic
  bool solve(const std::vector<bool>& is_given, const dealii::Vector<double>& load,
             dealii::Vector<double>& u);

  /// Frees the memory of factors, which solve() makes again when they are needed.
  void free_factors();

  /// r_p - S_p u
  dealii::Vector<double> residual(const dealii::Vector<double>& load,
                                  const dealii::Vector<double>& u) const;

private:
  struct Factor;

  CondensedSystem(KeptUnknowns unknowns, const dealii::LAPACKFullMatrix<double>& factor,
                  const dealii::Vector<double>& shift, MPI_Comm communicator);

  std::unique_ptr<const Factor> factorise(const std::vector<bool>& is_given) const;
  dealii::LAPACKFullMatrix<double> matrix_of_interface() const;
  void solve_inner(const dealii::Vector<double>& load, dealii::Vector<double>& u) const;

  const KeptUnknowns unknowns;
  const MPI_Comm processes;
  dealii::LAPACKFullMatrix<double> schur;       ///< S_p
  dealii::LAPACKFullMatrix<double> inner_lower; ///< L with S_FF = L L^T where nothing is given
  std::unique_ptr<InterfaceSolver> interface;   ///< made by solve() where there is an interface
  std::unique_ptr<const Factor> last;           ///< of the unknowns given last
};

/// The memory in bytes that one process needs for the dense matrices of the unknowns it keeps, of
/// which @p n_interface lie between processes.
double dense_bytes(double n_kept, double n_interface);

/// Called by all processes before anything of @p n_nodes contact nodes of each is made.
/// @throws NotEnoughMemory on all processes if they have less than it takes
void require_dense_memory(double n_nodes, MPI_Comm communicator);

} // namespace rollwave
