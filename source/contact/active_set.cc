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

/// Releases @p n_more nodes on both sides of each node that leaves contact. Returns their number.
unsigned int release_more(const std::vector<bool>& active, int n_more, std::vector<bool>& next) {
  const int n = next.size();
  const std::vector<bool> proposed = next;
  unsigned int n_released = 0;
  for (int i = 0; i < n; ++i)
    if (active[i] && !proposed[i])
      for (int j = std::max(i - n_more, 0); j <= std::min(i + n_more, n - 1); ++j) {
        n_released += next[j];
        next[j] = false;
      }
  return n_released;
}

/// True if a node enters contact.
bool has_entry(const std::vector<bool>& active, const std::vector<bool>& next) {
  for (unsigned int i = 0; i < active.size(); ++i)
    if (next[i] && !active[i])
      return true;
  return false;
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
  bool changes_one_by_one = false, has_long_steps = true;
  int n_shrinking = 0; // steps since a node has last entered contact
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
                      " nodes still change; raise Contact/Most steps (with a given load or nip the "
                      "active set searches the distance, whatever Contact/Method is)");
    if (is_repeated && has_long_steps) {
      has_long_steps = false;
      visited.clear();
    } else if (is_repeated) {
      changes_one_by_one = true;
      solution.notes.push_back(
          {Note::Kind::remark,
           "the active set repeated itself; from then on one node changed at a time"});
    }
    if (changes_one_by_one) {
      keep_first_change(solution.active, next);
      step.changed = 1;
    }
    // Where cells are stretched along r, an end of contact moves by a node or two in a step.
    constexpr int few = 3, most_doublings = 20;
    n_shrinking = has_entry(solution.active, next) ? 0 : n_shrinking + 1;
    if (has_long_steps && n_shrinking >= few) {
      step.changed +=
          release_more(solution.active, 1 << std::min(n_shrinking - few, most_doublings), next);
    }
    solution.active = std::move(next);
  }
}

} // namespace rollwave
