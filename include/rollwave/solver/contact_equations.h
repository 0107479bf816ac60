#pragma once

#include "rollwave/solver/condensed_system.h"

#include <utility>
#include <vector>

namespace rollwave {

/**
 * The linear problem S u = g - N as the contact iteration of one run sees it. The contact nodes of
 * the run are a stretch of those of the CondensedSystem; the others, which lie in the zones of
 * further runs, are free.
 */
class ContactEquations {
public:
  /// @param system must outlive it
  /// @param g load on all nodes of the system, without entries for none
  /// @param first number of the first contact node of the run in the system
  ContactEquations(const CondensedSystem& system, dealii::Vector<double> g, unsigned int first,
                   unsigned int n)
      : system(system), g(std::move(g)), first(first), n(n) {}

  /// Solves with u_i given on the pinned nodes and N_i on the others; sets N_i on the pinned nodes
  /// and u_i on the others. All arrays have one entry for each contact node of the run.
  void solve(const std::vector<bool>& pinned, ContactState& state, RunStatistics& statistics) const;

  /// The displacement C N of the contact nodes towards the hub when nodal forces N push on them and
  /// nothing else does: C is the compliance, the inverse of the Schur complement of these nodes.
  dealii::Vector<double> apply_compliance(const dealii::Vector<double>& force) const;

  /// The derivative of solve() by the displacement given: the change of the state when the pinned
  /// nodes move by @p displacement, the forces on the others and the load staying as they are.
  ContactState derivative(const std::vector<bool>& pinned,
                          const dealii::Vector<double>& displacement,
                          RunStatistics& statistics) const;

  /// The displacement of all nodes of the system.
  dealii::Vector<double> complete(const dealii::Vector<double>& displacement,
                                  RunStatistics& statistics) const;

private:
  /// From values on the nodes of the run to values on all of them, zero elsewhere, and back.
  template <typename Values>
  Values on_all(const Values& values) const;
  dealii::Vector<double> on_run(const dealii::Vector<double>& values) const;

  const CondensedSystem& system;
  const dealii::Vector<double> g;
  const unsigned int first, n;
};

} // namespace rollwave
