#pragma once

#include "rollwave/contact/contact_problem.h"

#include <vector>

namespace rollwave {

/**
 * The method of Ross and Bercovier: with p = -lambda <= 0, from p = 0 or the pressures lambda of @p
 * start,
 *
 *     p <- min(0, p - rho (u_h(p) - phi))   on the contact nodes,
 *     u_h(p):  a(u_h, v) = (f, v) + [p, v]_h  for all v.
 *
 * Let theta be the largest eigenvalue of the compliance on a set of nodes, see
 * largest_compliance(). The method converges from any start if 0 < rho < 2 / theta for the set of
 * all contact nodes. It diverges if rho >= 2 / theta for the nodes that are in contact at the
 * solution. active_set() finds these before the first step if rho is not safe, and a rho that
 * diverges is refused, since a loose tolerance might be met before the residual grows. Between the
 * two the residual may stop falling.
 *
 * Residuals are relative to the displacement by contact, u_h(p) - u_h(0), or, if that is smaller,
 * to the displacement and the road at the nodes that are pressed.
 *
 * @throws NotSolved when it diverges, with the largest rho that can converge, or after
 *         options.most_steps steps.
 */
ContactSolution uzawa(const ContactEquations& equations, const ContactProblem& problem,
                      const ContactOptions& options, const dealii::Vector<double>& start,
                      RunStatistics& statistics, const ContactObserver& step_ended = {});

/**
 * The largest eigenvalue theta of the compliance, displacement over pressure, of the contact nodes
 * selected by @p nodes: C M x = theta x, C = S^-1 restricted to them, M the diagonal of their
 * weights. By power iteration, which approaches it from below, to a relative accuracy of about
 * 1e-6.
 */
double largest_compliance(const ContactEquations& equations, const ContactProblem& problem,
                          const std::vector<bool>& nodes);

} // namespace rollwave
