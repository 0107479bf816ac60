#pragma once

#include "rollwave/exact/bessel_modes.h"
#include "rollwave/exact/exact_scene.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <functional>
#include <memory>
#include <vector>

namespace rollwave {

/**
 * The pressure of a contact |x| < w as n even terms of a GegenbauerPressure: u(b, x) = phi(x) is
 * tested by the terms themselves. Sums over modes run exactly up to some k, then as integrals, then
 * as the mean of their asymptotic form.
 */
class GalerkinPressure {
public:
  /// @param end_exponent of the pressure at |x| = w
  /// @p scene and @p modes must live as long.
  GalerkinPressure(const ExactScene& scene, const BesselModes& modes, double end_exponent,
                   unsigned int n_terms);
  ~GalerkinPressure();

  /// The coefficients of the even terms, and by how much the test by one more term fails.
  struct Trial {
    dealii::Vector<double> coefficients;
    double defect;
  };

  /// @throws NotSolved where too many modes would be needed.
  Trial solve(double half_width) const;

  /// int h_i (1 - t^2)^(nu - 1/2) C_i(t) F(w t) dt for the even i, F being @p function.
  dealii::Vector<double> moments(double half_width,
                                 const std::function<double(double)>& function) const;

  const double nu; ///< of the Gegenbauer polynomials
  const unsigned int n;

private:
  struct ModeSum;

  dealii::FullMatrix<double> interaction(double half_width) const;

  const ExactScene& scene;
  const BesselModes& modes;
  const double s;
  std::vector<double> points, weights;    ///< of Gauss' rule for the weight (1 - t^2)^(nu - 1/2)
  dealii::FullMatrix<double> polynomials; ///< h_i C_i at the points, for the even i
  mutable std::unique_ptr<ModeSum> sum;   ///< made for a half-width near sum_width
  mutable double sum_width = 0;
};

} // namespace rollwave
