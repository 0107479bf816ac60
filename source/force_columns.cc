#include "force_columns.h"

#include "scene.h"

#include <boost/math/special_functions/legendre.hpp>
#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rollwave {

using namespace dealii;

namespace {

constexpr unsigned int n_points = 16;

/// P_0(x), ..., P_n(x) with n = n_points.
std::array<double, n_points + 1> legendre(double x) {
  std::array<double, n_points + 1> p;
  p[0] = 1;
  p[1] = x;
  for (unsigned int k = 1; k < n_points; ++k)
    p[k + 1] = boost::math::legendre_next(k, x, p[k], p[k - 1]);
  return p;
}

} // namespace

ForceColumns::ForceColumns(const Scene& scene, unsigned int n_panels) : scene(scene) {
  for (unsigned int i = 0; i < n_panels; ++i)
    ends.push_back(scene.inner_radius *
                   std::pow(scene.outer_radius / scene.inner_radius, double(i) / n_panels));
  ends.push_back(scene.outer_radius);
}

const ForceColumns::Column& ForceColumns::at(double z) {
  if (scene.uniform_force)
    z = 0; // one for all
  const auto found = known.find(z);
  return found != known.end() ? found->second : known.emplace(z, make(z)).first->second;
}

bool ForceColumns::are_exact() const {
  return scene.uniform_force.has_value();
}

ForceColumns::Column ForceColumns::make(double z) const {
  static const QGauss<1> gauss(n_points);
  static const auto polynomials = [] {
    std::vector<std::array<double, n_points + 1>> all;
    for (const auto& point : gauss.get_points())
      all.push_back(legendre(2 * point[0] - 1));
    return all;
  }();
  Column column;
  column.scene = &scene;
  column.ends = &ends;
  if (scene.uniform_force)
    return column;
  const unsigned int n_panels = ends.size() - 1;
  column.coefficients.assign(n_panels, std::vector<double>(n_points, 0.));
  column.outside.assign(n_panels, 0.);
  const double angle = std::fmod(z, 2 * numbers::PI);
  for (unsigned int panel = n_panels; panel-- > 0;) {
    const double length = ends[panel + 1] - ends[panel];
    auto& coefficients = column.coefficients[panel];
    for (unsigned int q = 0; q < n_points; ++q) {
      const double r = ends[panel] + length * gauss.point(q)[0];
      const double value = gauss.weight(q) * r * scene.force(r, angle);
      for (unsigned int k = 0; k < n_points; ++k)
        coefficients[k] += (2 * k + 1) * value * polynomials[q][k];
    }
    if (panel > 0)
      column.outside[panel - 1] = column.outside[panel] + length * coefficients[0];
  }
  return column;
}

double ForceColumns::Column::integral(double r) const {
  if (scene->uniform_force) {
    const double b = scene->outer_radius;
    return *scene->uniform_force * (b - r) * (b + r) / 2;
  }
  const auto next = std::upper_bound(ends->begin() + 1, ends->end() - 1, r);
  const unsigned int panel = next - ends->begin() - 1;
  const double length = (*ends)[panel + 1] - (*ends)[panel];
  const double x = 2 * (r - (*ends)[panel]) / length - 1;
  const auto p = legendre(x);
  // int_x^1 P_k = (P_(k-1)(x) - P_(k+1)(x)) / (2 k + 1)
  double sum = coefficients[panel][0] * (1 - x);
  for (unsigned int k = 1; k < n_points; ++k)
    sum += coefficients[panel][k] * (p[k - 1] - p[k + 1]) / (2 * k + 1);
  return outside[panel] + sum * length / 2;
}

double ForceColumns::Column::force(double r) const {
  if (scene->uniform_force)
    return *scene->uniform_force;
  const auto next = std::upper_bound(ends->begin() + 1, ends->end() - 1, r);
  const unsigned int panel = next - ends->begin() - 1;
  const double length = (*ends)[panel + 1] - (*ends)[panel];
  const auto p = legendre(2 * (r - (*ends)[panel]) / length - 1);
  double sum = 0;
  for (unsigned int k = 0; k < n_points; ++k)
    sum += coefficients[panel][k] * p[k];
  return sum / r;
}

} // namespace rollwave
