#pragma once

#include "rollwave/contact/contact_problem.h"

namespace rollwave {

/**
 * The primal-dual active set method, a semismooth Newton method (M. Hintermueller, K. Ito and
 * K. Kunisch, SIAM J. Optim. 13 (2002) 865-888). It starts from the contact-free solution or from a
 * set given; a step pins the active nodes to the road and solves, then drops the active nodes that
 * are pulled (N_i < 0) and adds the others that penetrate (u_i > phi_i), until nothing changes.
 * The usual criterion N_i + kappa (u_i - phi_i) > 0 gives the same set for every kappa > 0 if the
 * solves are exact. The method therefore has no kappa.
 *
 * Where contact has only shrunk for three steps, ever more neighbours of the nodes that leave are
 * released as well, twice as many in each step: an end of contact on cells that are stretched along
 * r moves by a node or two in a plain step. Nodes released too many penetrate and return at once.
 *
 * A set seen before would begin a cycle. First these long steps are given up; if it happens again,
 * only the first node of the wrong sign changes in each step from then on, the least-index rule,
 * which ends for every symmetric positive definite matrix (K. G. Murty, Opsearch 11 (1974); J. J.
 * Judice and F. M. Pires, Comput. Oper. Res. 21 (1994)).
 *
 * @param start nodal pressures: nodes with a positive one are active at first. If it is empty, no
 *        node is.
 * @throws NotSolved after @p most_steps steps.
 */
ContactSolution active_set(const ContactEquations& equations, const ContactProblem& problem,
                           unsigned int most_steps, const dealii::Vector<double>& start,
                           RunStatistics& statistics, const ContactObserver& step_ended = {});

} // namespace rollwave
