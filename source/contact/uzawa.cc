#include "rollwave/contact/uzawa.h"

#include "rollwave/base/errors.h"
#include "rollwave/contact/active_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

/// Of the displacement by contact, relative to the whole: less is round-off.
constexpr double least_size = 1e-14;

/// The largest rho that can converge to a solution in which these nodes are in contact; nullopt
/// without contact.
std::optional<double> largest_step_length(const ContactEquations& equations,
                                          const ContactProblem& problem,
                                          const std::vector<bool>& active) {
  if (std::find(active.begin(), active.end(), true) == active.end())
    return {};
  return 2 / largest_compliance(equations, problem, active);
}

/// @param unit the problem's unit of displacement over pressure
std::string diverges_text(const StepLength& length, double unit) {
  std::ostringstream text;
  text << "Uzawa's method diverges with rho = " << length.rho / unit << "; lower Contact/Rho: ";
  if (length.largest)
    text << "the largest rho that can converge is " << *length.largest / unit << ", and ";
  text << "every rho below " << length.safe / unit << " does";
  return text.str();
}

/// Refuses a step length that cannot converge. Where rho is too large u grows, and with it the
/// residual that suffices, so that the iteration need not show it. The active set method finds the
/// nodes in contact. @return the length with the largest that can converge
StepLength checked_long_step(const ContactEquations& equations, const ContactProblem& problem,
                             StepLength length, RunStatistics& statistics) {
  constexpr unsigned int no_limit = std::numeric_limits<unsigned int>::max();
  const ContactSolution exact = active_set(equations, problem, no_limit, {}, statistics);
  length.largest = largest_step_length(equations, problem, exact.active);
  if (length.largest && length.rho >= *length.largest)
    throw NotSolved(diverges_text(length, problem.unit));
  return length;
}

/// On an iteration whose violation of the contact conditions has stopped falling.
std::string stagnates_text(const ContactOptions& options, double rho, std::size_t steps,
                           double smallest) {
  std::ostringstream text;
  text << "Uzawa's method stagnates with rho = " << rho << ": the smallest violation of " << steps
       << " steps is " << smallest << " of the displacement, wanted " << options.tolerance
       << "; raise Contact/Tolerance above round-off";
  return text.str();
}

/// @param rho in the user's unit
std::string too_few_steps_text(const ContactOptions& options, double rho,
                               const std::vector<ContactStep>& history) {
  std::ostringstream message;
  message << "Uzawa's method has not reached the tolerance " << options.tolerance << " after "
          << options.most_steps << " steps with rho = " << rho << ": the residual is "
          << *history.back().residual << "; raise Contact/Most steps"
          << (options.rho ? ", or let Contact/Rho be auto" : "");
  return message.str();
}

/// Puts the pressures @p start on the nodes, none if it has no entries. Returns p = -lambda.
Vector<double> begin_with(const ContactProblem& problem, const Vector<double>& start,
                          ContactSolution& solution) {
  const unsigned int n = problem.size();
  Vector<double> p(n);
  if (start.size() > 0)
    p.equ(-1, start);
  solution.active.resize(n);
  for (unsigned int i = 0; i < n; ++i)
    solution.active[i] = p(i) < 0;
  solution.state.displacement.reinit(n);
  solution.state.force = problem.forces(p);
  solution.state.force *= -1;
  return p;
}

/// The displacement of the contact nodes without contact.
Vector<double> contact_free_displacement(const ContactEquations& equations, unsigned int n,
                                         RunStatistics& statistics) {
  ContactState free = {Vector<double>(n), Vector<double>(n)};
  equations.solve(std::vector<bool>(n, false), free, statistics);
  return free.displacement;
}

/// p <- min(0, p - rho (u - phi)) for p = -lambda, with the nodal forces of it. The residual of the
/// step is |change of p| / rho in the l2 norm.
ContactStep project(const ContactProblem& problem, double rho, Vector<double>& p,
                    ContactSolution& solution) {
  ContactStep step = {};
  const Vector<double>& displacement = solution.state.displacement;
  double violation_squared = 0;
  for (unsigned int i = 0; i < problem.size(); ++i) {
    const double next = std::min(0., p(i) - rho * (displacement(i) - problem.phi(i)));
    violation_squared += std::pow((next - p(i)) / rho, 2);
    p(i) = next;
    step.active += next < 0;
    step.changed += solution.active[i] != (next < 0);
    solution.active[i] = next < 0;
    step.penetration = std::max(step.penetration, displacement(i) - problem.phi(i));
  }
  solution.state.force = problem.forces(p);
  solution.state.force *= -1;
  step.residual = std::sqrt(violation_squared);
  return step;
}

/// The size by which residuals are divided, an l2 norm over the contact nodes. It is the smaller of
/// two: that of the displacement by contact, which a light contact on a large displacement needs,
/// and that of displacement and road at the pressed nodes. Under a large force, contact takes
/// nearly all of the displacement back, and needs the second. The displacement alone may pass
/// through zero on its way.
/// @param free the displacement without contact
double size_for_residuals(const ContactProblem& problem, const ContactSolution& solution,
                          const Vector<double>& free) {
  const Vector<double>& displacement = solution.state.displacement;
  Vector<double> by_contact = displacement;
  by_contact -= free;
  double squared = displacement.norm_sqr();
  for (unsigned int i = 0; i < problem.size(); ++i)
    if (solution.active[i])
      squared += std::pow(problem.phi(i), 2);
  return std::max(std::min(by_contact.l2_norm(), std::sqrt(squared)),
                  least_size * displacement.l2_norm());
}

} // namespace

double largest_compliance(const ContactEquations& equations, const ContactProblem& problem,
                          const std::vector<bool>& nodes) {
  // The dominant mode is a push of one sign everywhere.
  Vector<double> pressure(problem.size());
  for (unsigned int i = 0; i < problem.size(); ++i)
    pressure(i) = nodes[i] ? 1. : 0.;

  double compliance = 0;
  for (unsigned int iteration = 0; iteration < 100; ++iteration) {
    const Vector<double> force = problem.forces(pressure);
    const Vector<double> response = equations.apply_compliance(force);
    double work = 0, norm_squared = 0, largest = 0;
    for (unsigned int i = 0; i < problem.size(); ++i) {
      work += force(i) * response(i);
      norm_squared += force(i) * pressure(i);
      pressure(i) = nodes[i] ? response(i) : 0.;
      largest = std::max(largest, std::abs(pressure(i)));
    }
    const double previous = compliance;
    compliance = work / norm_squared;
    pressure /= largest;
    if (compliance - previous < 1e-7 * compliance)
      break;
  }
  return compliance;
}

ContactSolution uzawa(const ContactEquations& equations, const ContactProblem& problem,
                      const ContactOptions& options, const Vector<double>& start,
                      RunStatistics& statistics, const ContactObserver& step_ended) {
  const std::vector<bool> none(problem.size(), false), all(problem.size(), true);
  const double safe = 2 / largest_compliance(equations, problem, all),
               rho = options.rho ? *options.rho * problem.unit : 0.9 * safe;
  StepLength length = {rho, safe, {}};
  if (rho >= safe)
    length = checked_long_step(equations, problem, length, statistics);
  ContactSolution solution;
  Vector<double> p = begin_with(problem, start, solution);
  const Vector<double>& displacement = solution.state.displacement;
  const Vector<double> free = contact_free_displacement(equations, problem.size(), statistics);
  equations.solve(none, solution.state, statistics);

  double smallest = std::numeric_limits<double>::max();
  unsigned int steps_without_progress = 0;
  while (solution.history.size() < options.most_steps) {
    Vector<double> change = displacement;
    ContactStep step = project(problem, rho, p, solution);
    const double violation = *step.residual;
    if (violation > 0)
      equations.solve(none, solution.state, statistics);
    change -= displacement;

    const double size = size_for_residuals(problem, solution, free);
    const double measured = options.stop == UzawaStop::gap ? violation : change.l2_norm();
    step.residual = size > 0 ? measured / size : measured;
    solution.history.push_back(step);
    if (step_ended)
      step_ended(solution.history);
    // A scene without contact is solved when the first projection leaves p at zero. Short steps
    // change u by little, so that the contact conditions have to hold as well.
    if (measured <= options.tolerance * size && violation <= std::sqrt(options.tolerance) * size) {
      length.largest = largest_step_length(equations, problem, solution.active);
      solution.step_length = length;
      solution.gap_accuracy = std::max(options.tolerance * size, violation);
      return solution;
    }

    // Below the largest rho the violation falls, by little if rho is small; beyond it, it ends in
    // an oscillation.
    if (violation < smallest) {
      smallest = violation;
      steps_without_progress = 0;
    } else if (++steps_without_progress >= 200 || !std::isfinite(violation)) {
      if (rho < safe)
        throw NotSolved(
            stagnates_text(options, rho / problem.unit, solution.history.size(), smallest / size));
      throw NotSolved(diverges_text(length, problem.unit));
    }
  }
  throw NotSolved(too_few_steps_text(options, rho / problem.unit, solution.history));
}

} // namespace rollwave
