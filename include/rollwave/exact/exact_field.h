#pragma once

#include "rollwave/exact/exact_solution.h"

#include <vector>

namespace rollwave {

/// For each of @p radii, in ascending order, the coefficients of the exact u(r, .) over
/// cos(k (z - 3 pi/2)), k < @p n_modes, as many as are not negligible there. On the surface the
/// modes left out are of order n_modes^-(1 + s); inside modes fade like (r/b)^k, or faster than any
/// power at the critical speed.
std::vector<std::vector<double>> cosine_coefficients(const ExactSolution& solution,
                                                     unsigned int n_modes,
                                                     const std::vector<double>& radii);

/// u = sum_k c_k cos(k (z - 3 pi/2)) and its derivative by z.
struct AngularValue {
  double value, slope;
};
AngularValue cosine_sum(const std::vector<double>& coefficients, double z);

} // namespace rollwave
