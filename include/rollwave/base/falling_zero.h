#pragma once

#include <functional>
#include <utility>

namespace rollwave {

/// Arguments from the least to the greatest, which may be infinite.
struct ArgumentRange {
  double least, greatest;
};

/**
 * Where a falling function is zero: the two sides of a change of sign, by steps from @p start that
 * double, and by Boost's TOMS 748 between the last two. Both are the zero if the function is
 * exactly 0 there, and a limit of the @p range if the function has one sign up to there. The last
 * argument tried is one of them.
 *
 * @param first_step positive
 * @param tolerance of the distance between both sides, relative to them
 * @throws NotSolved for a value that is not finite, or after 300 trials
 */
std::pair<double, double> falling_zero(const std::function<double(double)>& function, double start,
                                       double at_start, double first_step,
                                       const ArgumentRange& range, double tolerance);

} // namespace rollwave
