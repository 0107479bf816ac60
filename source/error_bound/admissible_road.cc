#include "rollwave/error_bound/admissible_road.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace rollwave {

using dealii::numbers::PI;

namespace {

/// The sum of the semi-axes of the ellipse with the foci -1 and 1 through @p point.
double ellipse_through(const std::complex<double>& point) {
  const double size = std::abs(point + std::sqrt(point * point - 1.));
  return std::max(size, 1 / size);
}

/// The angle from the lowest point at which phi is singular, sin x = 1/m, as in Road.
std::complex<double> singularity(const Road& road) {
  const double m = std::max(1 + road.curvature * road.distance, 1e-300);
  return std::asin(std::complex<double>(1 / m));
}

} // namespace

AdmissibleRoad::AdmissibleRoad(const Road& road, const Obstacle& phi, double reach)
    : road(road), phi(phi), tangent(road.tangent_angle()),
      last_contact(road.is_convex() ? tangent - std::min(reach, tangent) / 8 : PI),
      value_at_last(road.displacement(last_contact)), slope_at_last(road.slope(last_contact)),
      value_at_tangent(std::sqrt(road.distance * (road.distance + 2 / road.curvature)) -
                       road.outer_radius),
      value_beyond(road.displacement(PI / 2)), singular(singularity(road)) {}

AdmissibleRoad::ValueAndSlope AdmissibleRoad::limit(double z) const {
  const double x = from_lowest_point(z);
  const bool may_touch = !road.is_convex() || std::abs(x) <= last_contact;
  if (may_touch)
    return {phi(z), phi.slope(z)};
  const double on_line = value_at_last + slope_at_last * (std::abs(x) - last_contact);
  if (on_line < value_beyond || std::abs(x) < tangent)
    return {on_line, std::copysign(slope_at_last, x)};
  return {value_beyond, 0};
}

double AdmissibleRoad::upper(double z) const {
  const double x = from_lowest_point(z), size = std::abs(x);
  if (!road.is_convex() || size <= last_contact || size >= tangent)
    return phi(z);
  const double share = (size - last_contact) / (tangent - last_contact);
  return (1 - share) * value_at_last + share * value_at_tangent;
}

std::vector<double> AdmissibleRoad::corners() const {
  if (!road.is_convex())
    return {};
  // Where the line meets the constant phi beyond the tangent.
  const double met = last_contact + (value_beyond - value_at_last) / slope_at_last;
  std::vector<double> corners = {-last_contact, last_contact, -tangent, tangent};
  if (met > tangent && met < PI)
    corners.insert(corners.end(), {-met, met});
  return corners;
}

bool AdmissibleRoad::is_resolved(double begin, double end) const {
  const double middle = from_lowest_point((begin + end) / 2), half = (end - begin) / 2;
  if (road.is_convex() && std::abs(middle) > last_contact)
    return true;
  constexpr double wanted = 6;
  for (const auto& place :
       {singular, -singular, PI - singular, singular - PI, 2 * PI - singular, singular - 2 * PI})
    if (ellipse_through((place - middle) / half) < wanted)
      return false;
  return true;
}

} // namespace rollwave
