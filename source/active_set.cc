#include "active_set.h"

#include "errors.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace rollwave {

using namespace dealii;

namespace {

/// Signs are judged beyond these multiples of the largest displacement and pressure: what exact
/// arithmetic would make zero comes out as round-off of this size.
constexpr double round_off = 1e-14;

ContactStep judge(const ContactProblem& problem, const ContactSolution& solution,
                  std::vector<bool>& next) {
  const auto& [displacement, force] = solution.state;
  double highest_pressure = 0;
  for (unsigned int i = 0; i < problem.size(); ++i)
    highest_pressure = std::max(highest_pressure, std::abs(force(i)) / problem.weight(i));
  const double scale = displacement.linfty_norm();

  ContactStep step = {};
  next = solution.active;
  for (unsigned int i = 0; i < problem.size(); ++i) {
    const double penetration = displacement(i) - problem.road(i);
    const double pressure = force(i) / problem.weight(i);
    if (solution.active[i]) {
      ++step.active;
      step.lowest_pressure = std::min(step.lowest_pressure, pressure);
      next[i] = pressure >= -round_off * highest_pressure;
    } else {
      step.penetration = std::max(step.penetration, penetration);
      next[i] = penetration > round_off * scale;
    }
    step.changed += next[i] != solution.active[i];
  }
  step.residual = static_cast<double>(step.changed) / problem.size();
  return step;
}

/// Undoes all changes from @p active to @p next but the first.
void keep_first_change(const std::vector<bool>& active, std::vector<bool>& next) {
  const auto first = std::mismatch(active.begin(), active.end(), next.begin()).first;
  std::copy(first + 1, active.end(), next.begin() + (first + 1 - active.begin()));
}

} // namespace

ContactSolution active_set(StiffnessSolver& solver, const ContactProblem& problem,
                           unsigned int most_steps) {
  ContactSolution solution;
  solution.active.assign(problem.size(), false);
  solution.state.displacement.reinit(problem.size());
  solution.state.force.reinit(problem.size());

  std::set<std::vector<bool>> visited;
  bool one_by_one = false;
  for (;;) {
    for (unsigned int i = 0; i < problem.size(); ++i)
      if (solution.active[i])
        solution.state.displacement(i) = problem.road(i);
      else
        solution.state.force(i) = 0;
    solver.solve(solution.active, solution.state);

    std::vector<bool> next;
    solution.history.push_back(judge(problem, solution, next));
    if (solution.history.back().changed == 0)
      return solution;
    if (solution.history.size() >= most_steps)
      throw NotSolved("the active set method has not ended after " + std::to_string(most_steps) +
                      " steps: " + std::to_string(solution.history.back().changed) +
                      " nodes still change; raise Contact/Most steps");

    one_by_one = one_by_one || !visited.insert(solution.active).second;
    if (one_by_one) {
      keep_first_change(solution.active, next);
      solution.history.back().changed = 1;
      solution.remark = "the active set repeated itself; from then on one node changed at a time";
    }
    solution.active = std::move(next);
  }
}

} // namespace rollwave
