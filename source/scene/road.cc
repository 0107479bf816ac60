#include "rollwave/scene/road.h"

#include <cmath>

namespace rollwave {

double from_lowest_point(double z) {
  constexpr double rounded = 4.71238898038468985769, // the double nearest to 3 pi/2
      rest = 1.8369701987210297e-16;
  return (z - rounded) - rest;
}

std::function<double(double)> flat_road(double outer_radius, double distance) {
  return [=](double z) {
    const double x = from_lowest_point(z), sine = std::sin(x / 2);
    return (distance - outer_radius) + 2 * distance * sine * sine / std::cos(x);
  };
}

std::function<double(double)> flat_road_slope(double distance) {
  return [=](double z) {
    const double x = from_lowest_point(z), cosine = std::cos(x);
    return distance * std::sin(x) / (cosine * cosine);
  };
}

} // namespace rollwave
