#include "rollwave/contact/uzawa.h"

#include "rollwave/base/errors.h"
#include "rollwave/contact/active_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

/// @param unit the problem's unit of displacement over pressure
std::string advice_on_rho(const StepLength& length, double unit) {
  std::ostringstream text;
  text << "lower Contact/Rho: ";
  if (length.largest)
    text << "the largest rho that can converge is " << *length.largest / unit << ", and ";
  text << "every rho below " << length.safe / unit << " does";
  return text.str();
}

/// The step length of @p options. Its limits are those of the nodes in contact at the solution,
/// which the active set method finds. @throws NotSolved if it diverges.
StepLength choose_step_length(ContactLinearSolver& solver, const ContactProblem& problem,
                              const ContactOptions& options, const Vector<double>& start) {
  constexpr unsigned int no_limit = std::numeric_limits<unsigned int>::max();
  const std::vector<bool> all(problem.size(), true),
      active = active_set(solver, problem, no_limit, start).active;
  const double safe = 2 / largest_compliance(solver, problem, all);
  StepLength length = {options.rho ? *options.rho * problem.unit : 0.9 * safe, safe, {}};
  if (std::find(active.begin(), active.end(), true) != active.end())
    length.largest = 2 / largest_compliance(solver, problem, active);
  if (length.largest && length.rho >= *length.largest) {
    std::ostringstream text;
    text << "Uzawa's method diverges with rho = " << length.rho / problem.unit << "; "
         << advice_on_rho(length, problem.unit);
    throw NotSolved(text.str());
  }
  return length;
}

/// On an iteration whose residual has stopped falling.
std::string no_progress_text(const ContactOptions& options, const StepLength& length, double unit,
                             std::size_t steps, double smallest) {
  const bool is_safe = length.rho < length.safe;
  std::ostringstream text;
  text << "Uzawa's method " << (is_safe ? "stagnates" : "diverges")
       << " with rho = " << length.rho / unit << ": the smallest residual of " << steps
       << " steps is " << smallest << ", wanted " << options.tolerance << "; "
       << (is_safe ? "raise Contact/Tolerance above round-off" : advice_on_rho(length, unit));
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

} // namespace

double largest_compliance(ContactLinearSolver& solver, const ContactProblem& problem,
                          const std::vector<bool>& nodes) {
  // The dominant mode is a push of one sign everywhere.
  Vector<double> pressure(problem.size());
  for (unsigned int i = 0; i < problem.size(); ++i)
    pressure(i) = nodes[i] ? 1. : 0.;

  double compliance = 0;
  for (unsigned int iteration = 0; iteration < 100; ++iteration) {
    const Vector<double> force = problem.forces(pressure);
    // The quotient below errs by the square of this.
    const Vector<double> response = solver.apply_compliance(force, 1e-6);
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

ContactSolution uzawa(ContactLinearSolver& solver, const ContactProblem& problem,
                      const ContactOptions& options, const Vector<double>& start,
                      const ContactObserver& step_ended) {
  const std::vector<bool> none(problem.size(), false);
  const StepLength length = choose_step_length(solver, problem, options, start);
  const double rho = length.rho;
  ContactSolution solution;
  solution.step_length = length;
  Vector<double> p = begin_with(problem, start, solution);
  const Vector<double>& displacement = solution.state.displacement;
  double accuracy = loose_accuracy;
  double residual = solver.solve(none, solution.state, accuracy);

  double smallest = std::numeric_limits<double>::max();
  unsigned int steps_without_progress = 0;
  while (solution.history.size() < options.most_steps) {
    Vector<double> change = displacement;
    ContactStep step = project(problem, rho, p, solution);
    const double violation = *step.residual;
    if (violation > 0)
      residual = solver.solve(none, solution.state, accuracy);
    change -= displacement;

    const double size = displacement.l2_norm();
    const double measured = options.stop == UzawaStop::gap ? violation : change.l2_norm();
    step.residual = size > 0 ? measured / size : measured;
    solution.history.push_back(step);
    if (step_ended)
      step_ended(solution.history);
    // A scene without contact is solved when the first projection leaves p at zero. Short steps
    // change u by little, so that the contact conditions have to hold as well.
    if (measured <= options.tolerance * size && violation <= std::sqrt(options.tolerance) * size) {
      solution.gap_accuracy = std::max(options.tolerance * size, violation);
      if (residual > final_accuracy)
        solver.solve(none, solution.state, final_accuracy);
      return solution;
    }
    // The linear problems are solved 100 times more accurately than the residual of the step.
    accuracy = std::min(*step.residual / 100, loose_accuracy);

    // Below the largest rho the residual falls; beyond it, it ends in an oscillation.
    if (*step.residual < smallest) {
      smallest = *step.residual;
      steps_without_progress = 0;
    } else if (++steps_without_progress >= 200 || !std::isfinite(*step.residual))
      throw NotSolved(
          no_progress_text(options, length, problem.unit, solution.history.size(), smallest));
  }
  throw NotSolved(too_few_steps_text(options, rho / problem.unit, solution.history));
}

} // namespace rollwave
