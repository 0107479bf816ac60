#pragma once

#include <complex>
#include <vector>

namespace rollwave {

/**
 * A pressure on (m - w, m + w) with algebraic ends, as a series of Gegenbauer polynomials,
 *
 *     lambda(z) = sum_n a_n h_n (1 - t^2)^(nu - 1/2) C_n^(nu)(t),   t = (z - m)/w,
 *     h_n = n! Gamma(nu) / (pi 2^(1 - nu) Gamma(n + 2 nu)),
 *
 * whose Fourier transform is known (NIST Digital Library of Mathematical Functions, 18.17.17):
 *
 *     int_-1^1 h_n (1 - t^2)^(nu - 1/2) C_n^(nu)(t) e^(i x t) dt = i^n x^-nu J_(n+nu)(x).
 *
 * For nu = 0 the limit is meant, h_n C_n^(nu) = T_n / pi. The exponent nu - 1/2 of the ends is 1 -
 * s where contact ends freely, -s where it is cut short.
 */
class GegenbauerPressure {
public:
  GegenbauerPressure(double middle, double half_width, double nu,
                     const std::vector<double>& coefficients);

  double operator()(double z) const;

  /// lambda(z) / (1 - t^2)^(nu - 1/2), a polynomial.
  double over_weight(double z) const;

  /// int lambda e^(i k (z - m)) dz
  std::complex<double> fourier_integral(double k) const;

  double middle() const { return m; }
  double half_width() const { return w; }
  double order() const { return nu; }

private:
  double m, w, nu;
  std::vector<double> a;
};

/// x^-nu J_(n+nu)(x) for n = 0, ..., count - 1 and x >= 0.
std::vector<double> gegenbauer_transforms(double nu, unsigned int count, double x);

/// h_n C_n^(nu)(t) for n = 0, ..., count - 1: the polynomials without the weight.
std::vector<double> gegenbauer_polynomials(double nu, unsigned int count, double t);

} // namespace rollwave
