#ifndef ROLLWAVE_SOLVER_DENSE_SCHUR_H
#define ROLLWAVE_SOLVER_DENSE_SCHUR_H

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <utility>
#include <vector>

namespace rollwave {

/**
 * The problem that is left on m nodes when all other unknowns are eliminated,
 *
 *     S u = g - N,   S = L L^T,
 *
 * with the dense lower triangle L given and, for each node, either u_i (pinned) or N_i.
 *
 * The leading block of L is the factor of that of S, and its trailing block that of what remains
 * when the leading nodes are eliminated too. Nodes before the first pinned one therefore need only
 * substitutions, and only the free nodes behind it a factorisation of their own: none when pinned
 * nodes are the last.
 */
class DenseSchur {
public:
  /// @param factor L, m x m; what lies above the diagonal is not used
  explicit DenseSchur(dealii::FullMatrix<double> factor) : factor(std::move(factor)) {}

  /// m
  unsigned int size() const { return factor.m(); }

  /// Sets u_i of the nodes that are not pinned and N_i of those that are.
  /// @return how many free nodes needed a factorisation
  unsigned int solve(const std::vector<bool>& pinned, const dealii::Vector<double>& load,
                     dealii::Vector<double>& displacement, dealii::Vector<double>& force) const;

  /// S^-1 force
  dealii::Vector<double> solve(dealii::Vector<double> force) const;

  /// L y
  dealii::Vector<double> multiply(dealii::Vector<double> y) const;

  /// L^T u
  dealii::Vector<double> transposed_multiply(dealii::Vector<double> u) const;

private:
  dealii::FullMatrix<double> factor;
};

} // namespace rollwave

#endif
