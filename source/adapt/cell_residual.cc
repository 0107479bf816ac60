#include "rollwave/adapt/cell_residual.h"

#include <deal.II/base/numbers.h>

#include <cmath>

namespace rollwave {

using namespace dealii;

std::vector<double> mapped(const std::vector<Point<1>>& points, double begin, double end) {
  std::vector<double> result;
  for (const auto& point : points)
    result.push_back(begin + (end - begin) * point[0]);
  return result;
}

Rectangle rectangle_of(const DoFHandler<2>::active_cell_iterator& cell) {
  const Point<2> low = cell->vertex(0), high = cell->vertex(3);
  return {low[0], high[0], low[1], high[1]};
}

ForceMoment::ForceMoment(unsigned int degree, const Quadrature<1>& rule)
    : gauss(degree), to_points(rule.size(), degree), at_gauss(degree) {
  const auto lagrange = Polynomials::generate_complete_Lagrange_basis(gauss.get_points());
  for (unsigned int q = 0; q < rule.size(); ++q)
    for (unsigned int i = 0; i < degree; ++i)
      to_points(q, i) = lagrange[i].value(rule.point(q)[0]);
}

void ForceMoment::reinit(const Scene& scene, const Rectangle& box) {
  for (unsigned int j = 0; j < gauss.size(); ++j) {
    const double z = std::fmod(box.z0 + box.length() * gauss.point(j)[0], 2 * numbers::PI);
    for (unsigned int i = 0; i < gauss.size(); ++i) {
      const double r = box.r0 + box.height() * gauss.point(i)[0];
      at_gauss(j, i) = r * scene.force(r, z);
    }
  }
}

double ForceMoment::value(unsigned int p, unsigned int q) const {
  double sum = 0;
  for (unsigned int j = 0; j < gauss.size(); ++j)
    for (unsigned int i = 0; i < gauss.size(); ++i)
      sum += to_points(p, j) * to_points(q, i) * at_gauss(j, i);
  return sum;
}

Lengths lengths_of(const Rectangle& box, const Scene& scene) {
  const double middle = (box.r0 + box.r1) / 2, thickness = scene.outer_radius - scene.inner_radius;
  // What varies in z has no more room between hub and surface than what varies in r.
  return {box.height() * box.height() / middle,
          std::min(box.length() * box.length() / scene.alpha(middle), thickness * thickness) /
              middle};
}

double weighted_square(unsigned int n, const ResidualValues& residual, const QGauss<1>& rule,
                       const Lengths& length) {
  NodeValues of_z = {}, of_r = {};
  double mean = 0;
  for (unsigned int p = 0; p < n; ++p)
    for (unsigned int q = 0; q < n; ++q) {
      of_z[p] += rule.weight(q) * residual[p][q];
      of_r[q] += rule.weight(p) * residual[p][q];
      mean += rule.weight(p) * rule.weight(q) * residual[p][q];
    }
  double sum = 0;
  for (unsigned int p = 0; p < n; ++p) {
    sum += rule.weight(p) * (length.angular * std::pow(of_z[p] - mean, 2) +
                             length.radial * std::pow(of_r[p] - mean, 2));
    for (unsigned int q = 0; q < n; ++q)
      sum += rule.weight(p) * rule.weight(q) * length.both() *
             std::pow(residual[p][q] - of_z[p] - of_r[q] + 2 * mean, 2);
  }
  return sum;
}

} // namespace rollwave
