#include "rollwave/error_bound/line_integral.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace rollwave {

using namespace dealii;

RadialIntervals::RadialIntervals(const std::vector<double>& radii,
                                 const dealii::Quadrature<1>& rule)
    : radii(radii), rule(rule), highest(rule.size(), 2) {
  for (const auto& polynomial : Polynomials::generate_complete_Lagrange_basis(rule.get_points()))
    primitives.push_back(polynomial.primitive());
  const QGauss<1> gauss(rule.size());
  const auto lagrange = Polynomials::generate_complete_Lagrange_basis(rule.get_points());
  for (const unsigned int mode : {0U, 1U}) {
    const Polynomials::Legendre legendre(rule.size() - 1 - mode);
    for (unsigned int i = 0; i < rule.size(); ++i)
      for (unsigned int q = 0; q < gauss.size(); ++q)
        highest(i, mode) += gauss.weight(q) * legendre.value(gauss.point(q)[0]) *
                            lagrange[i].value(gauss.point(q)[0]);
  }
}

double RadialIntervals::highest_modes(const double* values) const {
  double first = 0, second = 0;
  for (unsigned int i = 0; i < rule.size(); ++i) {
    first += highest(i, 0) * values[i];
    second += highest(i, 1) * values[i];
  }
  return std::abs(first) + std::abs(second);
}

std::vector<RadialIntervals::Place> RadialIntervals::places(const std::vector<double>& at) const {
  std::vector<Place> result;
  for (const double r : at) {
    const auto end = std::upper_bound(radii.begin() + 1, radii.end() - 1, r);
    const unsigned int k = end - radii.begin() - 1;
    const double t = (r - radii[k]) / length(k);
    result.push_back({k, {}});
    for (const auto& primitive : primitives)
      result.back().weights.push_back(length(k) * (primitive.value(1.) - primitive.value(t)));
  }
  return result;
}

Line::Line(const RadialIntervals& intervals, double innermost_radius,
           const std::function<double(double r)>& moment)
    : n(intervals.n_points()), moments(n * intervals.size()), beyond(intervals.size()),
      doubt(intervals.size()) {
  double sum = 0, sum_of_doubts = 0;
  for (unsigned int k = intervals.size(); k-- > 0;) {
    beyond[k] = sum;
    for (unsigned int i = 0; i < n; ++i) {
      moments[n * k + i] = moment(intervals.point(k, i));
      sum += intervals.weight(k, i) * moments[n * k + i];
    }
    sum_of_doubts += intervals.length(k) * intervals.highest_modes(&moments[n * k]);
    doubt[k] = sum_of_doubts;
    if (intervals.begin(k) <= innermost_radius)
      break;
  }
}

} // namespace rollwave
