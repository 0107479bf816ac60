#include "contact_ends.h"

#include <algorithm>

namespace rollwave {

namespace {

/// An end that is wrong by no more nodes than this is left to the signs: the laws behind the leaps
/// are those of the continuum.
constexpr int few = 4;

/// Nodes counted from @p first in the direction @p step, which is 1 or -1.
struct Walk {
  int first;
  int step;
  int operator()(int k) const { return first + k * step; }
};

/// Length of the surface that belongs to @p count nodes, up to a common factor.
double length(const ContactProblem& problem, const Walk& node, int count) {
  double sum = 0;
  for (int k = 0; k < count; ++k)
    sum += problem.weight(node(k));
  return sum;
}

/// How many nodes fit best into @p wanted of that length; at least one.
int nodes_within(const ContactProblem& problem, const Walk& node, double wanted, int most) {
  int count = 1;
  double sum = problem.weight(node(0));
  while (count < most && sum + problem.weight(node(count)) / 2 <= wanted)
    sum += problem.weight(node(count++));
  return count;
}

/// Drops @p n nodes from a stretch that goes on in the direction of the walk.
void drop(const Walk& node, int n, std::vector<bool>& next) {
  for (int k = 0; k < n; ++k)
    next[node(k)] = false;
}

/// Drops nodes from the end of a stretch of @p n active nodes whose end is pulled.
void drop_pulled_end(const ContactProblem& problem, const ContactSolution& solution,
                     const Walk& node, int n, std::vector<bool>& next) {
  int negative = 0;
  while (negative < n && !next[node(negative)])
    ++negative;
  int balanced = 0;
  double force = 0;
  while (balanced < n && force <= 0)
    force += solution.state.force(node(balanced++));
  if (negative == 0 || force <= 0 || balanced <= few)
    return;
  const double wanted = (length(problem, node, negative) + 2 * length(problem, node, balanced)) / 3;
  const int dropped = std::max(negative, nodes_within(problem, node, wanted, n));
  drop(node, dropped, next);
}

/// Of the nodes that penetrate next to an active stretch, keeps those nearest to it.
void trim_penetrating_end(const ContactProblem& problem, const Walk& node, int n,
                          std::vector<bool>& next) {
  int penetrating = 0;
  while (penetrating < n && next[node(penetrating)])
    ++penetrating;
  // A stretch that reaches the end of the zone or the next active one has no end of its own.
  if (penetrating <= few || penetrating == n)
    return;
  const double wanted = 2 * length(problem, node, penetrating) / 3;
  const int kept = nodes_within(problem, node, wanted, penetrating);
  for (int k = kept; k < penetrating; ++k)
    next[node(k)] = false;
}

/// Of the nodes from @p first to @p last that penetrate with no contact next to them, keeps the
/// middle of each stretch. Where one reaches the end of the zone it has no end of its own.
void trim_new_stretches(const ContactProblem& problem, int first, int last,
                        std::vector<bool>& next) {
  const int size = problem.size();
  for (int begin = first; begin <= last; ++begin) {
    int end = begin;
    while (end <= last && next[end])
      ++end;
    const int n = end - begin;
    const bool touches_contact = (begin == first && first > 0) || (end > last && last < size - 1);
    if (n > few && !touches_contact) {
      const Walk forward = {begin, 1}, backward = {end - 1, -1};
      const double wanted = length(problem, forward, n) / 8;
      const int low = nodes_within(problem, forward, wanted, n),
                high = nodes_within(problem, backward, wanted, n);
      if (begin > 0)
        drop(forward, low, next);
      if (end < size)
        drop(backward, high, next);
    }
    begin = end;
  }
}

} // namespace

void move_ends(const ContactProblem& problem, const ContactSolution& solution,
               std::vector<bool>& next) {
  const auto& active = solution.active;
  const int size = active.size();
  for (int first = 0; first < size;) {
    int last = first;
    while (last + 1 < size && active[last + 1] == active[first])
      ++last;
    const int n = last - first + 1;
    if (active[first]) {
      // Contact that begins or ends with the zone has no end there.
      if (first > 0)
        drop_pulled_end(problem, solution, {first, 1}, n, next);
      if (last < size - 1)
        drop_pulled_end(problem, solution, {last, -1}, n, next);
    } else {
      trim_new_stretches(problem, first, last, next);
      if (first > 0)
        trim_penetrating_end(problem, {first, 1}, n, next);
      if (last < size - 1)
        trim_penetrating_end(problem, {last, -1}, n, next);
    }
    first = last + 1;
  }
}

} // namespace rollwave
