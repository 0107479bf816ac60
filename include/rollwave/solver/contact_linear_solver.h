#pragma once

#include "rollwave/mesh/contact_boundary.h"

#include <deal.II/lac/vector.h>

#include <optional>
#include <vector>

namespace rollwave {

/// The accuracies of solve(): while the contact still changes, and for the final solution.
constexpr double loose_accuracy = 1e-4, final_accuracy = 1e-11;

struct Scene;
class RunStatistics;

/// The state of the contact nodes, in the order of ContactBoundary::contact_nodes().
struct ContactState {
  dealii::Vector<double> displacement; ///< u_i, a length

  /// N_i = f_i - (K u)_i, a force: positive where the road presses. Over the node's weight it is
  /// the contact pressure.
  dealii::Vector<double> force;
};

/**
 * The linear problem on one mesh, as contact iterations see it:
 *
 *     K u = f - N,   N = 0 except at contact nodes.
 *
 * At each contact node either u_i (pinned) or N_i is given. The contact nodes are few, and every
 * process has all of them. The other data of the solution are members of the two kinds of solver.
 */
class ContactLinearSolver {
public:
  virtual ~ContactLinearSolver() = default;

  /// Sets up a scene, which may differ from the one before in its speed, force, road and zone.
  /// Quantities that do not depend on these changes are kept. @p boundary has the nodes in the
  /// scene's zone, which are candidates of the solver. @p load is the vector of the force, nullopt
  /// when it is zero; it and @p statistics must live until the next call or the last use.
  /// @throws NotSolved when memory is short or K is not positive definite in rounded arithmetic.
  virtual void set_problem(const Scene& scene, const ContactBoundary& boundary,
                           const std::optional<FieldVector>& load, RunStatistics& statistics) = 0;

  /// Solves with u_i given on the pinned nodes and N_i on the others; sets N_i on the pinned nodes
  /// and u_i on the others. All arrays have one entry for each contact node.
  /// @param accuracy the relative residual |f - N - K u|_2 / max(|f|_2, |N|_2) that suffices
  /// @return the relative residual reached; 0 where the solution is exact up to round-off
  /// @throws NotSolved when the accuracy is out of reach.
  virtual double solve(const std::vector<bool>& pinned, ContactState& state, double accuracy) = 0;

  /// The displacement C N of the contact nodes towards the hub when nodal forces N push on them and
  /// nothing else does: C is the compliance, the inverse of the Schur complement of these nodes.
  /// @p accuracy is as for solve().
  virtual dealii::Vector<double> apply_compliance(const dealii::Vector<double>& force,
                                                  double accuracy) = 0;

  /// The derivative of solve() by the displacement given: the change of the state when the pinned
  /// nodes move by @p displacement, the forces on the others and the load staying as they are.
  /// @p accuracy is as for solve().
  virtual ContactState derivative(const std::vector<bool>& pinned,
                                  const dealii::Vector<double>& displacement, double accuracy) = 0;

  /// The field u of a state that solve() has left since set_problem(), constraints included.
  virtual FieldVector displacement_field(const ContactState& state) = 0;

  /// K u for a field that obeys the constraints; zero where a constraint holds.
  virtual FieldVector apply(const FieldVector& field) const = 0;
};

} // namespace rollwave
