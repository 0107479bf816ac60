#pragma once

#include "rollwave/solver/cholmod_factor.h"
#include "rollwave/solver/elimination_order.h"

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

namespace rollwave {

class RunStatistics;

/**
 * The sum K_p of the matrices of the cells of one process, factorised. The unknowns k that it keeps
 * are parted from the others (i), which only its own cells have:
 *
 *     ( K_ii  K_ik )
 *     ( K_ki  K_kk ),     S_p = K_kk - K_ki K_ii^-1 K_ik.
 *
 * This is the method of substructures (J. S. Przemieniecki, AIAA J. 1 (1963) 138-147). The sum of
 * all S_p ties the processes together, see CondensedSystem. Fields are zero where a constraint
 * holds. All processes must call the functions that take or return a field.
 */
class SparseFactor {
public:
  /// @param own the factor of K_p, to which @p shift is added on the diagonal of the interface
  SparseFactor(const RingSpace& space, EliminationOrder order, CholmodFactor own,
               dealii::Vector<double> shift);

  const KeptUnknowns& kept() const { return order.kept; }

  /// The lower triangular L with L L^T = S_p + shift.
  dealii::LAPACKFullMatrix<double> schur_factor() const { return own.schur_factor(); }

  /// What has been added on the diagonal of the interface. The cells of a process may lie away from
  /// the hub, and then S_p is singular. With this shift it has a factor.
  const dealii::Vector<double>& shift() const { return added; }

  /// rhs_k - K_ki K_ii^-1 rhs_i, with each entry of @p rhs on the process that owns it.
  dealii::Vector<double> condense(const FieldVector& rhs, RunStatistics& statistics) const;

  /// The field x with K_ii x_i = rhs_i - K_ik x_k. @param rhs null for zero @param kept x_k
  FieldVector expand(const FieldVector* rhs, const dealii::Vector<double>& kept,
                     RunStatistics& statistics) const;

  /// K x, of all processes.
  FieldVector apply(const FieldVector& x) const;

private:
  /// The values of a field at the unknowns of this process whose local index is below @p n_local;
  /// zeros at the others.
  std::vector<double> gather(const FieldVector& field, unsigned int n_local) const;

  const RingSpace& space;
  const EliminationOrder order;
  const CholmodFactor own;
  const dealii::Vector<double> added;
};

} // namespace rollwave
