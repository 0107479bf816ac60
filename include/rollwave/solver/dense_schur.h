#ifndef ROLLWAVE_SOLVER_DENSE_SCHUR_H
#define ROLLWAVE_SOLVER_DENSE_SCHUR_H

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace rollwave {

/**
 * The problem that is left on m nodes when all other unknowns are eliminated,
 *
 *     S u = g - N,   S = L L^T,
 *
 * with the dense lower triangle L given and, for each node, either u_i (pinned) or N_i.
 */
class DenseSchur {
public:
  /// @param factor L, m x m, with zeros above the diagonal
  explicit DenseSchur(const dealii::FullMatrix<double>& factor);

  /// m
  unsigned int size() const { return schur.m(); }

  /// Sets u_i of the nodes that are not pinned and N_i of those that are.
  /// @return whether this needed a factorisation, as with both kinds of nodes
  bool solve(const std::vector<bool>& pinned, const dealii::Vector<double>& load,
             dealii::Vector<double>& displacement, dealii::Vector<double>& force) const;

  /// S^-1 force
  dealii::Vector<double> solve(dealii::Vector<double> force) const;

  /// L y
  dealii::Vector<double> multiply(const dealii::Vector<double>& y) const;

  /// L^T u
  dealii::Vector<double> transposed_multiply(const dealii::Vector<double>& u) const;

private:
  dealii::LAPACKFullMatrix<double> factor, schur;
};

} // namespace rollwave

#endif
