#ifndef ROLLWAVE_ERROR_BOUND_LINE_INTEGRAL_H
#define ROLLWAVE_ERROR_BOUND_LINE_INTEGRAL_H

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace rollwave {

/// Where a force jumps on a line of the mesh, its cells end on their own side of it by this share.
constexpr double inside = 1e-8;

/// The intervals between given radii, on each of which r f is taken for the polynomial through the
/// points of a rule.
class RadialIntervals {
public:
  RadialIntervals(const std::vector<double>& radii, const dealii::Quadrature<1>& rule);

  unsigned int size() const { return radii.size() - 1; }
  unsigned int n_points() const { return rule.size(); }
  double begin(unsigned int k) const { return radii[k]; }
  double length(unsigned int k) const { return radii[k + 1] - radii[k]; }

  /// Within the interval, lest the force has jumped at its end.
  double point(unsigned int k, unsigned int i) const {
    return radii[k] + length(k) * std::clamp(rule.point(i)[0], inside, 1 - inside);
  }
  double weight(unsigned int k, unsigned int i) const { return length(k) * rule.weight(i); }

  /// The coefficients of the two highest Legendre polynomials, orthonormal on [0, 1], in the
  /// polynomial with these values at the points: their absolute sum.
  double highest_modes(const double* values) const;

  /// A radius, with the weights that integrate from there to the end of its interval.
  struct Place {
    unsigned int interval;
    std::vector<double> weights;
  };

  std::vector<Place> places(const std::vector<double>& at) const;

private:
  std::vector<double> radii; ///< increasing
  dealii::Quadrature<1> rule;
  dealii::FullMatrix<double> highest;
  std::vector<dealii::Polynomials::Polynomial<double>> primitives;
};

using Places = std::vector<RadialIntervals::Place>;

/// G on one line z = const.
class Line {
public:
  /// @param moment r f on the line
  Line(const RadialIntervals& intervals, double innermost_radius,
       const std::function<double(double r)>& moment);

  double at(const RadialIntervals::Place& place) const {
    double sum = beyond[place.interval];
    for (unsigned int i = 0; i < n; ++i)
      sum += place.weights[i] * moments[n * place.interval + i];
    return sum;
  }

  /// By how much at() may be off: a jump within an interval is no more than its highest modes.
  double doubt_at(const RadialIntervals::Place& place) const { return doubt[place.interval]; }

private:
  const unsigned int n;
  std::vector<double> moments; ///< at the points of all intervals
  std::vector<double> beyond;  ///< G at the end of each interval
  std::vector<double> doubt;   ///< from the begin of each interval on
};

} // namespace rollwave

#endif
