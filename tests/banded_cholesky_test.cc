// A banded matrix against the same matrix in full.
#include "rollwave/solver/banded_cholesky.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>
#include <gtest/gtest.h>

#include <random>

using namespace rollwave;

namespace {

/// A matrix with a strictly dominant diagonal, banded and full.
class Banded : public testing::TestWithParam<unsigned int> {
protected:
  Banded() : banded(GetParam()), full(n), x(n) {
    std::minstd_rand random(1);
    std::uniform_real_distribution<double> entries(-1, 1);
    banded.grow(n);
    for (unsigned int i = 0; i < n; ++i) {
      x[i] = entries(random);
      for (unsigned int d = 0; d <= GetParam() && i + d < n; ++d) {
        const double entry = d == 0 ? 2. * GetParam() + 1 : entries(random);
        banded(i, d) = full(i, i + d) = full(i + d, i) = entry;
      }
    }
  }

  /// Of full x.
  double product(unsigned int i) const {
    double sum = 0;
    for (unsigned int j = 0; j < n; ++j)
      sum += full(i, j) * x[j];
    return sum;
  }

  void clear_in_full(unsigned int i) {
    for (unsigned int j = 0; j < n; ++j)
      full(i, j) = full(j, i) = 0;
    full(i, i) = 1;
  }

  const unsigned int n = 12;
  BandedMatrix banded;
  dealii::FullMatrix<double> full;
  std::vector<double> x;
};

TEST_P(Banded, MultipliesAsAFullMatrixDoes) {
  banded.clear(4);
  clear_in_full(4);
  const std::vector<double> y = banded.multiply(x);
  ASSERT_EQ(y.size(), n);
  for (unsigned int i = 0; i < n; ++i)
    EXPECT_NEAR(y[i], product(i), 1e-14);
}

TEST_P(Banded, SolvesWhatItMultiplied) {
  const std::vector<double> y = banded.multiply(x);
  banded.factorise();
  const std::vector<double> solution = banded.solve(y);
  for (unsigned int i = 0; i < n; ++i)
    EXPECT_NEAR(solution[i], x[i], 1e-13);
}

TEST_P(Banded, LeavesClearedRowsAlone) {
  banded.clear(4);
  clear_in_full(4);
  banded.factorise();
  banded.clear(n - 1); // of the factors
  clear_in_full(n - 1);
  std::vector<double> y(n);
  for (unsigned int i = 0; i < n; ++i)
    y[i] = product(i);
  y[4] = 7;
  y[n - 1] = 8;
  const std::vector<double> solution = banded.solve(y);
  for (unsigned int i = 0; i < n; ++i)
    EXPECT_NEAR(solution[i], i == 4 ? 7. : i == n - 1 ? 8. : x[i], 1e-13);
}

// The minimiser with the last value given.
TEST_P(Banded, FollowsAChangeOfTheLastRow) {
  banded.factorise();
  std::vector<double> change(n);
  change[n - 1] = 0.3;
  const std::vector<double> g = banded.follow(change);
  EXPECT_NEAR(g[n - 1], 0.3, 1e-15);
  for (unsigned int i = 0; i + 1 < n; ++i) {
    double residual = 0;
    for (unsigned int j = 0; j < n; ++j)
      residual += full(i, j) * g[j];
    EXPECT_NEAR(residual, 0, 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(Width, Banded, testing::Values(1, 2, 5));

} // namespace
