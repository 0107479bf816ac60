#include "rollwave/contact/active_set.h"

#include "rollwave/base/errors.h"

#include <algorithm>
#include <set>

namespace rollwave {

using namespace dealii;

namespace {

/// Relative to the largest displacement and pressure: smaller numbers are round-off and count as
/// zero.
constexpr double round_off = 1e-14;

/// Checks the contact conditions of a state, and proposes the @p next set.
ContactStep check_conditions(const ContactProblem& problem, const ContactSolution& solution,
                             std::vector<bool>& next) {
  const auto& [displacement, force, kept] = solution.state;
  const Vector<double> gap = problem.gaps(displacement), pressure = problem.pressures(force);
  const double least_pressure = -round_off * pressure.linfty_norm(),
               least_gap = -round_off * displacement.linfty_norm();

  ContactStep step = {};
  next = solution.active;
  for (unsigned int i = 0; i < problem.size(); ++i) {
    if (solution.active[i]) {
      ++step.active;
      step.lowest_pressure = std::min(step.lowest_pressure, pressure(i));
      next[i] = pressure(i) >= least_pressure;
    } else {
      step.penetration = std::max(step.penetration, -gap(i));
      next[i] = gap(i) < least_gap;
    }
    step.changed += next[i] != solution.active[i];
  }
  return step;
}

/// Undoes all changes from @p active to @p next but the first.
void keep_first_change(const std::vector<bool>& active, std::vector<bool>& next) {
  const auto first = std::mismatch(active.begin(), active.end(), next.begin()).first;
  std::copy(first + 1, active.end(), next.begin() + (first + 1 - active.begin()));
}

/// Puts the active nodes on the road, and takes the forces off the others.
void pin(const ContactProblem& problem, ContactSolution& solution) {
  for (unsigned int i = 0; i < problem.size(); ++i)
    if (solution.active[i])
      solution.state.displacement(i) = problem.phi(i);
    else
      solution.state.force(i) = 0;
}

} // namespace

ContactSolution active_set(const ContactEquations& equations, const ContactProblem& problem,
                           unsigned int most_steps, const Vector<double>& start,
                           RunStatistics& statistics, const ContactObserver& step_ended) {
  ContactSolution solution;
  solution.active.assign(problem.size(), false);
  for (unsigned int i = 0; i < start.size(); ++i)
    solution.active[i] = start(i) > 0;
  solution.state.displacement.reinit(problem.size());
  solution.state.force.reinit(problem.size());
  bool changes_one_by_one = false;
  std::set<std::vector<bool>> visited;
  for (;;) {
    pin(problem, solution);
    equations.solve(solution.active, solution.state, statistics);
    std::vector<bool> next;
    solution.history.push_back(check_conditions(problem, solution, next));
    ContactStep& step = solution.history.back();
    const bool is_last = step.changed == 0, is_repeated = !is_last && !changes_one_by_one &&
                                                          !visited.insert(solution.active).second;
    if (step_ended)
      step_ended(solution.history);
    if (is_last)
      return solution;
    if (solution.history.size() >= most_steps)
      throw NotSolved("the active set method has not ended after " + std::to_string(most_steps) +
                      " steps: " + std::to_string(step.changed) +
                      " nodes still change; raise Contact/Most steps");
    if (is_repeated) {
      changes_one_by_one = true;
      solution.remark = "the active set repeated itself; from then on one node changed at a time";
    }
    if (changes_one_by_one) {
      keep_first_change(solution.active, next);
      step.changed = 1;
    }
    solution.active = std::move(next);
  }
}

} // namespace rollwave
