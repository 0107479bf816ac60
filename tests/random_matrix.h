#pragma once

#include "rollwave/solver/cholmod_factor.h"

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <random>

namespace rollwave {

/// A random sparse symmetric positive definite matrix, as triplets and in full.
struct RandomMatrix {
  explicit RandomMatrix(int n) : full(n, n) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> value(-1, 1);
    for (int i = 0; i < n; ++i)
      add(i, i, n);
    for (int k = 0; k < 4 * n; ++k)
      add(random() % n, random() % n, value(random));
  }

  void add(int i, int j, double value) {
    triplets.add(std::max(i, j), std::min(i, j), value);
    full(i, j) += value;
    if (i != j)
      full(j, i) += value;
  }

  LowerTriplets triplets;
  dealii::FullMatrix<double> full;
};

} // namespace rollwave
