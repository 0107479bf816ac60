#include "rollwave/base/falling_zero.h"

#include "rollwave/base/errors.h"

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>

namespace rollwave {

std::pair<double, double> falling_zero(const std::function<double(double)>& function, double start,
                                       double at_start, double first_step,
                                       const ArgumentRange& range, double tolerance) {
  constexpr std::uintmax_t most_trials = 300;
  const auto finite = [](double x, double value) {
    if (std::isfinite(value))
      return value;
    std::ostringstream text;
    text << "the search for the distance meets a number that is not finite at " << x;
    throw NotSolved(text.str());
  };
  const auto value_at = [&](double x) { return finite(x, function(x)); };
  const auto is_narrow = [tolerance](double left, double right) {
    return right - left <= tolerance * std::abs(right);
  };

  double x = start, value = finite(start, at_start), step = finite(start, first_step);
  for (std::uintmax_t trial = 0; trial < most_trials; ++trial, step *= 2) {
    const double limit = value > 0 ? range.greatest : range.least;
    if (value == 0 || x == limit)
      return {x, x};
    const double next = value > 0 ? std::min(x + step, limit) : std::max(x - step, limit);
    const double at_next = value_at(next);
    if ((at_next > 0) == (value > 0) && at_next != 0) {
      x = next;
      value = at_next;
      continue;
    }
    std::uintmax_t n_trials = most_trials;
    const auto sides = next > x ? boost::math::tools::toms748_solve(value_at, x, next, value,
                                                                    at_next, is_narrow, n_trials)
                                : boost::math::tools::toms748_solve(value_at, next, x, at_next,
                                                                    value, is_narrow, n_trials);
    if (n_trials >= most_trials && !is_narrow(sides.first, sides.second))
      break;
    return sides;
  }
  throw NotSolved("no distance was found after " + std::to_string(most_trials) + " trials");
}

} // namespace rollwave
