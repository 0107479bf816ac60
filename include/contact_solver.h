#ifndef ROLLWAVE_CONTACT_SOLVER_H
#define ROLLWAVE_CONTACT_SOLVER_H

#include "parameters.h"
#include "stiffness_solver.h"

#include <optional>
#include <string>
#include <vector>

namespace rollwave {

/**
 * The discrete contact conditions, for every contact node i:
 *
 *     u_i <= phi_i,   N_i >= 0,   N_i (phi_i - u_i) = 0,   pressure lambda_i = N_i / weight_i.
 */
struct ContactProblem {
  dealii::Vector<double> road;           ///< phi_i, a length
  dealii::Vector<double> weight;         ///< the nodes' areas, see SurfaceNode
  double unit = 1;                       ///< of length, Scene::unit
  MPI_Comm communicator = MPI_COMM_SELF; ///< of the processes that solve it together

  unsigned int size() const { return road.size(); }
};

/// What contact methods ask of StiffnessSolver::solve(): little while the contact still changes,
/// and what the solution they return shall hold to.
constexpr double loose_accuracy = 1e-4, final_accuracy = 1e-11;

/// The contact conditions at the contact nodes of @p space.
ContactProblem make_contact_problem(const RingSpace& space, const Scene& scene);

/// One line of the history of a contact iteration.
struct ContactStep {
  unsigned int active;    ///< nodes in contact
  unsigned int changed;   ///< nodes that entered or left contact after this step
  double penetration;     ///< max (u_i - phi_i, 0), a length
  double lowest_pressure; ///< min (lambda_i, 0)

  /// Active set: the number of changed nodes over that of all. Uzawa: what its stopping rule
  /// measures, relative to u.
  double residual;
};

struct ContactSolution {
  ContactState state;
  std::vector<bool> active;
  std::vector<ContactStep> history;
  double rho = 0;          ///< Uzawa's step length; 0 for the active set method
  std::string remark = ""; ///< anything unusual the user should know

  /// Where the user has interrupted the iteration: after what, and what is missing.
  std::optional<std::string> shortfall;
};

/// Solves by the method of @p parameters, beginning with the contact pressures @p start (none when
/// it has no entries). @throws NotSolved as the methods do.
ContactSolution solve_contact(StiffnessSolver& solver, const ContactProblem& problem,
                              const Parameters& parameters,
                              const dealii::Vector<double>& start = {});

} // namespace rollwave

#endif
