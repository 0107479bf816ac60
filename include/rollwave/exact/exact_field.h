#pragma once

#include "rollwave/exact/bessel_modes.h"
#include "rollwave/exact/exact_solution.h"

#include <vector>

namespace rollwave {

/// The exact u and its derivatives, as a sum over modes.
class ExactField {
public:
  /// Sums the modes k < @p n_modes: on the surface the rest of u is of order n_modes^-(1 + s),
  /// inside modes fade like (r/b)^k or faster than any power at the critical speed.
  ExactField(const ExactScene& scene, const ExactSolution& solution, unsigned int n_modes);

  struct Value {
    double displacement;
    double radial_derivative;
    double angular_derivative;
  };

  /// At a <= r <= b and any angle.
  Value operator()(double r, double z) const;

  /// For each of @p radii, in ascending order, the coefficients of u(r, .) over
  /// cos(k (z - 3 pi/2)), as many as are not negligible there.
  std::vector<std::vector<double>> cosine_coefficients(const std::vector<double>& radii) const;

private:
  ExactScene scene;
  BesselModes modes;
  std::vector<double> amplitudes; ///< of cos(k x) in u(b, .)
};

} // namespace rollwave
