#include "active_set.h"

#include "contact_ends.h"
#include "errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace rollwave {

using namespace dealii;

namespace {

/// Signs are judged beyond these multiples of the largest displacement and pressure: what exact
/// arithmetic would make zero comes out as round-off of this size.
constexpr double round_off = 1e-14;

/// The same where the equations hold up to a residual. The displacement is as accurate as they are;
/// the pressure, a residual over a weight, is less so where cells are small.
constexpr double displacement_error = 1, pressure_error = 10; // over the residual

unsigned int count_changes(const std::vector<bool>& active, const std::vector<bool>& next) {
  unsigned int count = 0;
  for (unsigned int i = 0; i < active.size(); ++i)
    count += active[i] != next[i];
  return count;
}

ContactStep judge(const ContactProblem& problem, const ContactSolution& solution, double residual,
                  std::vector<bool>& next) {
  const auto& [displacement, force] = solution.state;
  double highest_pressure = 0;
  for (unsigned int i = 0; i < problem.size(); ++i)
    highest_pressure = std::max(highest_pressure, std::abs(force(i)) / problem.weight(i));
  const double least_pressure = -std::max(round_off, pressure_error * residual) * highest_pressure;
  const double most_penetration =
      std::max(round_off, displacement_error * residual) * displacement.linfty_norm();

  ContactStep step = {};
  next = solution.active;
  for (unsigned int i = 0; i < problem.size(); ++i) {
    const double penetration = displacement(i) - problem.road(i);
    const double pressure = force(i) / problem.weight(i);
    if (solution.active[i]) {
      ++step.active;
      step.lowest_pressure = std::min(step.lowest_pressure, pressure);
      next[i] = pressure >= least_pressure;
    } else {
      step.penetration = std::max(step.penetration, penetration);
      next[i] = penetration > most_penetration;
    }
  }
  step.changed = count_changes(solution.active, next);
  return step;
}

/// Whether contact has more than two ends within the zone.
bool is_torn(const std::vector<bool>& active) {
  unsigned int ends = 0;
  for (unsigned int i = 0; i + 1 < active.size(); ++i)
    ends += active[i] != active[i + 1];
  return ends > 2;
}

/// Sweeps that bring a set nearer to the solution. Where contact is torn, one that has not been
/// found after more steps needs more of them. Where the factor of the contact nodes does not fit
/// into caches a sweep costs as much as a step.
unsigned int count_sweeps(unsigned int n_nodes, bool tears, unsigned int steps) {
  constexpr unsigned int many_nodes = 1000, few_sweeps = 2, many_sweeps = 10;
  if (n_nodes >= many_nodes)
    return few_sweeps;
  return tears ? many_sweeps * steps : many_sweeps;
}

/// The set that is nearer to the solution than @p next, which nodes of the wrong sign have left or
/// entered: the ends have leapt. Where contact is torn all nodes are relaxed instead if the solver
/// can, and where it has not been found by leaps in three steps, those that have not leapt.
std::vector<bool> predict(const StiffnessSolver& solver, const ContactProblem& problem,
                          const ContactSolution& solution, const std::vector<bool>& next) {
  const bool tears = is_torn(solution.active) || is_torn(next);
  const unsigned int steps = solution.history.size();
  std::vector<bool> predicted = next;
  move_ends(problem, solution, predicted);
  if (!tears && steps < 3)
    return predicted;
  Vector<double> limit = problem.road;
  if (!tears)
    for (unsigned int i = 0; i < problem.size(); ++i)
      if (next[i] && !predicted[i])
        limit(i) = std::numeric_limits<double>::infinity();
  ContactState relaxed = solution.state;
  if (solver.relax(limit, count_sweeps(problem.size(), tears, steps), relaxed))
    for (unsigned int i = 0; i < problem.size(); ++i)
      predicted[i] = relaxed.displacement(i) == limit(i) && relaxed.force(i) >= 0;
  return predicted == solution.active ? next : predicted;
}

/// Undoes all changes from @p active to @p next but the first.
void keep_first_change(const std::vector<bool>& active, std::vector<bool>& next) {
  const auto first = std::mismatch(active.begin(), active.end(), next.begin()).first;
  std::copy(first + 1, active.end(), next.begin() + (first + 1 - active.begin()));
}

} // namespace

ContactSolution active_set(StiffnessSolver& solver, const ContactProblem& problem,
                           unsigned int most_steps, const Vector<double>& start) {
  ContactSolution solution;
  solution.active.assign(problem.size(), false);
  for (unsigned int i = 0; i < start.size(); ++i)
    solution.active[i] = start(i) > 0;
  solution.state.displacement.reinit(problem.size());
  solution.state.force.reinit(problem.size());

  enum class Change { predicted, by_sign, one_by_one } change = Change::predicted;
  std::set<std::vector<bool>> visited;
  double accuracy = loose_accuracy;
  for (;;) {
    for (unsigned int i = 0; i < problem.size(); ++i)
      if (solution.active[i])
        solution.state.displacement(i) = problem.road(i);
      else
        solution.state.force(i) = 0;
    double residual = solver.solve(solution.active, solution.state, accuracy);

    std::vector<bool> next;
    solution.history.push_back(judge(problem, solution, residual, next));
    ContactStep& step = solution.history.back();
    const bool is_loose = accuracy > final_accuracy && residual > final_accuracy;
    if (step.changed == 0 && is_loose) {
      accuracy = final_accuracy;
      residual = solver.solve(solution.active, solution.state, accuracy);
      step = judge(problem, solution, residual, next);
    }
    if (step.changed == 0)
      return solution;
    if (solution.history.size() >= most_steps)
      throw NotSolved("the active set method has not ended after " + std::to_string(most_steps) +
                      " steps: " + std::to_string(step.changed) +
                      " nodes still change; raise Contact/Most steps");

    if (change != Change::one_by_one && !visited.insert(solution.active).second) {
      if (is_loose) {
        // The signs of a loose solve have led here; those of an accurate one may lead on.
        accuracy = final_accuracy;
        visited.clear();
        solution.history.pop_back();
        continue;
      }
      change = change == Change::predicted ? Change::by_sign : Change::one_by_one;
      solution.remark =
          change == Change::by_sign
              ? "the active set repeated itself; from then on it changed by sign alone"
              : "the active set repeated itself; from then on one node changed at a "
                "time";
      visited = {solution.active};
    }
    if (change == Change::predicted)
      next = predict(solver, problem, solution, next);
    else if (change == Change::one_by_one)
      keep_first_change(solution.active, next);
    step.changed = count_changes(solution.active, next);
    step.residual = static_cast<double>(step.changed) / problem.size();
    solution.active = std::move(next);
  }
}

} // namespace rollwave
