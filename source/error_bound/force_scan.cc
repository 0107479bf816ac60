#include "rollwave/error_bound/force_scan.h"

#include "rollwave/scene/scene.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

namespace {

/// The integral of w from given radii to the last of some ends, for w taken on each interval
/// between ends for the polynomial through the points of a rule.
class InwardIntegral {
public:
  InwardIntegral(const std::vector<double>& ends, const Quadrature<1>& rule,
                 const std::vector<double>& radii)
      : ends(ends), rule(rule) {
    std::vector<Polynomials::Polynomial<double>> primitives;
    for (const auto& shape : Polynomials::generate_complete_Lagrange_basis(rule.get_points()))
      primitives.push_back(shape.primitive());
    for (const double r : radii) {
      const auto end = std::upper_bound(ends.begin() + 1, ends.end() - 1, r);
      const unsigned int k = end - ends.begin() - 1;
      const double length = ends[k + 1] - ends[k], t = (r - ends[k]) / length;
      intervals.push_back(k);
      for (const auto& primitive : primitives)
        weights.push_back(length * (primitive.value(1.) - primitive.value(t)));
    }
  }

  template <typename Function>
  std::vector<double> of(const Function& w) const {
    const unsigned int n = rule.size();
    std::vector<double> at_points(n * (ends.size() - 1)), beyond(ends.size());
    for (unsigned int k = ends.size() - 1; k-- > 0;) {
      const double length = ends[k + 1] - ends[k];
      beyond[k] = beyond[k + 1];
      for (unsigned int i = 0; i < n; ++i) {
        at_points[n * k + i] = w(ends[k] + length * rule.point(i)[0]);
        beyond[k] += length * rule.weight(i) * at_points[n * k + i];
      }
    }
    std::vector<double> integrals;
    for (unsigned int q = 0; q < intervals.size(); ++q) {
      const unsigned int k = intervals[q];
      integrals.push_back(beyond[k + 1]);
      for (unsigned int i = 0; i < n; ++i)
        integrals.back() += weights[n * q + i] * at_points[n * k + i];
    }
    return integrals;
  }

private:
  const std::vector<double> ends;
  const Quadrature<1> rule;
  std::vector<unsigned int> intervals; ///< of each radius
  std::vector<double> weights;         ///< of each radius, for the points of its interval
};

} // namespace

ForceScan::ForceScan(const Scene& scene, const QGauss<1>& rule)
    : scene(scene), rule(rule),
      lagrange(Polynomials::generate_complete_Lagrange_basis(rule.get_points())) {}

double ForceScan::force(double r, double z) {
  const double f = scene.force(r, z);
  if (!std::isfinite(f)) {
    if (first_refusal.empty())
      first_refusal = force_not_finite_at(scene, r, z);
    return 0;
  }
  if (std::abs(f) > largest_value) {
    largest_value = std::abs(f);
    place = {r, z};
  }
  return f;
}

ForceScan::Sector ForceScan::sector(const std::vector<double>& ends,
                                    const std::vector<double>& radii, double begin, double length) {
  std::vector<double> narrow_ends = {ends.front()};
  for (unsigned int k = 0; k + 1 < ends.size(); ++k)
    for (unsigned int i = 1; i <= n_points / 2; ++i)
      narrow_ends.push_back(ends[k] + (ends[k + 1] - ends[k]) * i / (n_points / 2));
  const InwardIntegral by_gauss(ends, QGauss<1>(rule.size()), radii),
      coarse(ends, QMidpoint<1>(), radii), narrow(narrow_ends, QGauss<1>(2), radii);
  const auto on_line = [&](const InwardIntegral& integral, double t) {
    const double z = std::fmod(begin + t * length, 2 * numbers::PI);
    return integral.of([&](double r) { return r * force(r, z); });
  };
  Sector sector;
  std::vector<std::vector<double>> coarse_lines;
  for (const Point<1>& point : rule.get_points()) {
    sector.lines.push_back(on_line(by_gauss, point[0]));
    coarse_lines.push_back(on_line(coarse, point[0]));
  }
  // Along z, with one radius for each cell
  std::vector<double> squares(radii.size());
  for (unsigned int i = 0; i < n_points; ++i) {
    // Jumps at the ends are those of the neighbour.
    const double t = std::clamp(i / (n_points - 1.), 1e-8, 1 - 1e-8);
    std::vector<double> missed = on_line(coarse, t);
    for (unsigned int p = 0; p < rule.size(); ++p) {
      const double share = lagrange[p].value(t);
      for (unsigned int q = 0; q < radii.size(); ++q)
        missed[q] -= share * coarse_lines[p][q];
    }
    for (unsigned int q = 0; q < radii.size(); ++q)
      squares[q] += missed[q] * missed[q] / n_points;
  }
  // Along r, on one of the lines
  const unsigned int middle = rule.size() / 2;
  const std::vector<double> seen = on_line(narrow, rule.point(middle)[0]);
  for (unsigned int q = 0; q < radii.size(); ++q)
    sector.missed.push_back(2 *
                            (std::abs(seen[q] - sector.lines[middle][q]) + std::sqrt(squares[q])));
  return sector;
}

bool ForceScan::has_pole(const Point<2>& distances) const {
  constexpr double closer = 4;
  Point<2> nearest = place;
  double value = largest_value, share = 1;
  for (int level = 0; level < 10; ++level, share /= closer) {
    const Point<2> middle = nearest;
    for (const unsigned int direction : {0U, 1U})
      for (double step = -1; step <= 1; step += 1 / closer) {
        Point<2> near = middle;
        near[direction] += step * share * distances[direction];
        near[0] = std::clamp(near[0], scene.inner_radius, scene.outer_radius);
        near[1] = std::clamp(near[1], 0., 2 * numbers::PI);
        const double f = std::abs(scene.force(near[0], near[1]));
        if (!std::isfinite(f))
          return true;
        if (f > value) {
          value = f;
          nearest = near;
        }
      }
  }
  return largest_value > 0 && share * std::pow(value / largest_value, 2) > 1;
}

} // namespace rollwave
