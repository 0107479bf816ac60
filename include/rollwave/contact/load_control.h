#ifndef ROLLWAVE_CONTACT_LOAD_CONTROL_H
#define ROLLWAVE_CONTACT_LOAD_CONTROL_H

#include "rollwave/contact/contact_problem.h"

namespace rollwave {

/**
 * -d/dc of the three loads while the nodes in contact stay the same, forces over lengths. Pinned
 * nodes follow the road, du_i = (dphi/dc)(z_i) dc, which takes one solution with these nodes
 * pinned. For the work-conjugate load it is J''(c) of the discrete problem,
 *
 *     J'' = g' S g - sum_i N_i d^2 phi/dc^2(z_i),   g_i = dphi/dc(z_i).
 *
 * S is the Schur complement of the nodes in contact. @p solver is at the scene of @p problem.
 * @throws NotSolved as ContactLinearSolver::solve().
 */
Loads contact_stiffness(ContactLinearSolver& solver, const ContactProblem& problem,
                        const ContactSolution& solution);

/// A distance and the nodal pressures there.
struct RoadPosition {
  double distance;
  dealii::Vector<double> pressure;
};

/**
 * The road's distance at which the load is that of Scene::load, by Newton's method with
 * contact_stiffness() within a bracket, to 1e-10 of the load: the active set method finds the
 * contact for each distance, beginning with that of the distance before. The first is that of @p
 * scene, with the pressures @p start.
 *
 * @throws BadValue where even a road at Scene::least_distance is not pressed as much,
 *         NotSolved as active_set(), or when it does not settle.
 */
RoadPosition find_distance(ContactLinearSolver& solver, const RingSpace& space, const Scene& scene,
                           unsigned int most_steps, const dealii::Vector<double>& start);

} // namespace rollwave

#endif
