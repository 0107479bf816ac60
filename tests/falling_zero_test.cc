// The search for a zero ends for every function.
#include "rollwave/base/errors.h"
#include "rollwave/base/falling_zero.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace rollwave;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::pair<double, double> zero_of(const std::function<double(double)>& function, double start,
                                  double first_step, const ArgumentRange& range = {0, infinity}) {
  return falling_zero(function, start, function(start), first_step, range, 1e-15);
}

TEST(FallingZero, IsFoundFromBothSides) {
  const auto function = [](double x) { return std::exp(-x) - std::exp(-2.); };
  for (const double start : {0., 1., 2., 2.5, 50.})
    for (const double step : {1e-9, 0.3, 100.}) {
      const auto [left, right] = zero_of(function, start, step);
      EXPECT_NEAR(left, 2, 4e-15);
      EXPECT_NEAR(right, 2, 4e-15);
    }
}

TEST(FallingZero, OfAJumpLiesBetweenNeighbours) {
  const auto [left, right] = zero_of([](double x) { return x < 1.3 ? 2. : -1e-3; }, 0.5, 0.1);
  EXPECT_LT(left, 1.3);
  EXPECT_GE(right, 1.3);
  EXPECT_NEAR(left, right, 3e-15);
}

TEST(FallingZero, IsALimitWhereTheSignStays) {
  const ArgumentRange range = {1, 3};
  EXPECT_EQ(zero_of([](double) { return -1.; }, 2, 1e-3, range), std::pair(1., 1.));
  EXPECT_EQ(zero_of([](double) { return 1.; }, 2, 1e-3, range), std::pair(3., 3.));
}

TEST(FallingZero, EndsAtNumbersThatAreNotFinite) {
  for (const double value : {std::nan(""), infinity, -infinity})
    for (const double start : {0.5, 1.5}) {
      const auto function = [value](double x) { return x < 1 ? 1 - x : value; };
      EXPECT_THROW(zero_of(function, start, 0.3), NotSolved) << value << ' ' << start;
    }
  EXPECT_THROW(zero_of([](double) { return 1.; }, 2, 1), NotSolved);
  EXPECT_THROW(zero_of([](double) { return 1.; }, 2, 0), NotSolved);
}

} // namespace
