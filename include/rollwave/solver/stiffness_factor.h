#pragma once

#include "rollwave/mesh/contact_boundary.h"
#include "rollwave/solver/sparse_factor.h"

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <memory>
#include <optional>

namespace rollwave {

struct Scene;

/**
 * The stiffness matrix K of a space at one speed, factorised with the contact nodes (c) parted from
 * the others (i). Static condensation makes of K u = f - N, N = 0 except at contact nodes,
 *
 *     S u_c = g - N_c,   S = K_cc - K_ci K_ii^-1 K_ic,   g = f_c - K_ci K_ii^-1 f_i,
 *
 * a small dense problem. All processes must call all functions.
 */
class StiffnessFactor {
public:
  /// @throws NotEnoughMemory, or NotSolved where K is not positive definite in rounded arithmetic
  StiffnessFactor(const ContactBoundary& boundary, const Scene& scene, RunStatistics& statistics);

  /// The lower triangular L with L L^T = S, on all processes.
  dealii::LAPACKFullMatrix<double> schur_factor() const { return factor->schur_factor(); }

  /// g for the load @p f.
  dealii::Vector<double> condense(const FieldVector& f, RunStatistics& statistics) const {
    return factor->condense(f, statistics);
  }

  /// The field u with K_ii u_i = f_i - K_ic u_c, constraints included.
  /// @param f the load, nullptr for none @param contact_displacement u_c
  /// @throws NotSolved where u is not finite
  FieldVector expand(const FieldVector* f, const dealii::Vector<double>& contact_displacement,
                     RunStatistics& statistics) const;

  /// K u for a field that obeys the constraints; zero where a constraint holds.
  FieldVector apply(const FieldVector& u) const { return factor->apply(u); }

private:
  const ContactBoundary boundary;
  std::unique_ptr<const SparseFactor> factor;
};

} // namespace rollwave
