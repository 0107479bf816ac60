#ifndef ROLLWAVE_ERROR_BOUND_FORCE_SCAN_H
#define ROLLWAVE_ERROR_BOUND_FORCE_SCAN_H

#include <deal.II/base/point.h>
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

#include <string>
#include <vector>

namespace rollwave {

struct Scene;

/// Takes G(r, z) = int_r^b rho f(rho, z) drho on lines z = const, and measures what it misses by
/// looking at f in many more points.
class ForceScan {
public:
  /// Points to a cell in each direction.
  static constexpr unsigned int n_points = 32;

  /// How far they are apart at most, as a share of the cell: those of Gauss' rule with two points.
  static constexpr double widest_gap = 0.5774 / (n_points / 2);

  /// @param rule along z
  ForceScan(const Scene& scene, const dealii::QGauss<1>& rule);

  /// G at some radii in an angular interval.
  struct Sector {
    std::vector<std::vector<double>> lines; ///< on the lines of the rule
    std::vector<double> missed; ///< twice the root mean square over the interval of G - G_h
  };

  /// Looks at f on an interval [begin, begin + length] of z.
  /// @param ends of the radial intervals on which f r is taken for a polynomial, to b
  Sector sector(const std::vector<double>& ends, const std::vector<double>& radii, double begin,
                double length);

  /// Why f cannot be taken; empty where it was finite.
  const std::string& refusal() const { return first_refusal; }

  /// The largest |f| seen.
  double largest() const { return largest_value; }

  /// Whether f^2 times the distance of points grows when they draw nearer to the largest |f|, from
  /// the distances of the scan on.
  bool has_pole(const dealii::Point<2>& distances) const;

private:
  double force(double r, double z);

  const Scene& scene;
  const dealii::QGauss<1> rule;
  const std::vector<dealii::Polynomials::Polynomial<double>> lagrange; ///< of its points
  std::string first_refusal;
  double largest_value = 0;
  dealii::Point<2> place; ///< of the largest |f|
};

} // namespace rollwave

#endif
