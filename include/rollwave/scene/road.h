#ifndef ROLLWAVE_SCENE_ROAD_H
#define ROLLWAVE_SCENE_ROAD_H

#include <functional>

namespace rollwave {

/// x = z - 3 pi/2, the angle from the lowest point, to the accuracy of z: 3 pi/2 is taken in two
/// parts.
double from_lowest_point(double z);

/// phi(z) = -b - c / sin z for sin z < 0: a flat road at the distance c below the axle. Near the
/// lowest point nothing cancels: phi = (c - b) + 2 c sin^2(x/2) / cos x, x = z - 3 pi/2.
std::function<double(double)> flat_road(double outer_radius, double distance);

/// phi'(z) = c cos z / sin^2 z of the same road.
std::function<double(double)> flat_road_slope(double distance);

} // namespace rollwave

#endif
