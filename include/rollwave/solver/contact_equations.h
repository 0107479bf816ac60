#pragma once

#include "rollwave/solver/condensed_system.h"

#include <deal.II/lac/vector.h>

#include <optional>
#include <utility>
#include <vector>

namespace rollwave {

class RunStatistics;

/// Displacements and forces of contact nodes.
struct ContactState {
  dealii::Vector<double> displacement; ///< u_i, a length

  /// N_i = f_i - (K u)_i, a force: positive where the road presses. Over the node's weight it is
  /// the contact pressure.
  dealii::Vector<double> force;

  /// u at the unknowns that this process keeps, from which SparseFactor::expand() makes the field;
  /// set by ContactEquations::solve().
  dealii::Vector<double> kept = {};
};

/**
 * The linear problem S u = g - N as the contact iteration of one run sees it. The contact nodes of
 * the run are a stretch of those of a mesh; the others, which lie in the zones of further runs, are
 * free, and so are the unknowns between processes.
 *
 * At each node either u_i (pinned) or N_i is given. All processes have the same numbers: each
 * counts its own, and MPI sums them up, with one result for all (MPI 3.1, 5.9.6). All processes
 * must call all functions.
 */
class ContactEquations {
public:
  /// @param system must outlive it
  /// @param g the condensed load of this process, without entries for none
  /// @param first number of the first contact node of the run among those of the mesh
  ContactEquations(CondensedSystem& system, dealii::Vector<double> g, unsigned int first,
                   unsigned int n)
      : system(system), g(std::move(g)), first(first), n(n) {}

  /// Solves with u_i given on the pinned nodes and N_i on the others; sets N_i on the pinned nodes
  /// and u_i on the others. All arrays have one entry for each contact node of the run.
  /// @throws NotSolved where the matrix is not positive definite in rounded arithmetic
  void solve(const std::vector<bool>& pinned, ContactState& state, RunStatistics& statistics) const;

  /// The displacement C N of the contact nodes towards the hub when nodal forces N push on them and
  /// nothing else does: C is the compliance, the inverse of the Schur complement of these nodes.
  dealii::Vector<double> apply_compliance(const dealii::Vector<double>& force) const;

  /// The derivative of solve() by the displacement given: the change of the state when the pinned
  /// nodes move by @p displacement, the forces on the others and the load staying as they are.
  ContactState derivative(const std::vector<bool>& pinned,
                          const dealii::Vector<double>& displacement,
                          RunStatistics& statistics) const;

private:
  /// The number among the nodes of the run of an unknown that this process keeps, if it is one.
  std::optional<unsigned int> node(unsigned int kept) const;

  /// @return whether a block of the matrix has been factorised
  bool solve(const std::vector<bool>& pinned, dealii::Vector<double> load,
             ContactState& state) const;

  CondensedSystem& system;
  const dealii::Vector<double> g;
  const unsigned int first, n;
};

} // namespace rollwave
