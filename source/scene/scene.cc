#include "rollwave/scene/scene.h"

#include "rollwave/base/errors.h"
#include "rollwave/exact/uniform_force.h"
#include "rollwave/scene/force_expression.h"
#include "rollwave/scene/road.h"

#include <deal.II/base/numbers.h>

#include <cmath>
#include <limits>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

template <typename... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::digits10);
  (out << ... << parts);
  return out.str();
}

/// Refuses radii and a speed for which the problem is not posed, or not elliptic.
void check_cylinder(const CylinderOptions& cylinder) {
  const auto refuse = [&](const std::string& key, const std::string& wanted) {
    throw BadValue("Cylinder", key, wanted);
  };
  if (!(cylinder.outer_radius > cylinder.inner_radius))
    refuse("Outer radius",
           text("it must be greater than the inner radius ", cylinder.inner_radius));

  constexpr double least_ratio = 1e-150; // whose square can be held
  if (cylinder.inner_radius < least_ratio * cylinder.outer_radius)
    refuse("Inner radius", text("it must be at least ", least_ratio, " of the outer radius"));

  // The user's 1/b has been rounded, at most by the last digits of a decimal number.
  const double critical = 1 / cylinder.outer_radius;
  if (cylinder.angular_velocity > critical * (1 + 4 * std::numeric_limits<double>::epsilon()))
    refuse("Angular velocity", text("beyond 1/b = ", critical,
                                    " the problem is no longer elliptic: the surface moves faster "
                                    "than the waves"));
}

void check_road(const CylinderOptions& cylinder, const RoadOptions& road) {
  const double b = cylinder.outer_radius, c = road.distance;
  const auto refuse = [&](const std::string& key, const std::string& wanted) {
    throw BadValue("Road", key, wanted);
  };
  if (!(c > cylinder.inner_radius))
    refuse("Distance", text("the road reaches the hub; it must be greater than the inner radius ",
                            cylinder.inner_radius));
  if (const auto& zone = road.contact_zone) {
    if (!(numbers::PI < zone->first && zone->first < zone->second &&
          zone->second < 2 * numbers::PI))
      refuse("Contact zone",
             text("it must be \"auto\" or \"z0, z1\" with pi < z0 < z1 < 2 pi, that "
                  "is 3.14159... < z0 < z1 < 6.28318..."));
  } else if (!(c < 2 * b))
    refuse("Distance",
           text("the zone of possible contact, where phi < b, is empty; it must be less "
                "than twice the outer radius ",
                b));
}

/// Half the angle in which the surface can touch a flat road. Contact pushes inwards, so that u <=
/// u_f, the displacement without contact: where the force is uniform, contact ends before phi =
/// u_f. Two cells are added, since contact that ends within a cell is felt next to it. An uneven
/// force has phi < b as its limit, and no zone goes beyond that.
double possible_half_width(const Scene& scene, double distance, unsigned int angular_cells) {
  const double a = scene.inner_radius, b = scene.outer_radius;
  const double widest = std::acos(distance / (2 * b));
  if (scene.has_uneven_force())
    return widest;
  const double free = scene.uniform_force.value_or(0) * contact_free_unit_displacement(a, b, b);
  return std::min(widest, crossing_angle(b, distance, free) + 4 * numbers::PI / angular_cells);
}

} // namespace

std::string force_not_finite_at(const Scene& scene, double r, double z) {
  std::ostringstream text;
  text << "it is not finite at r = " << r * scene.unit << ", z = " << z;
  return text.str();
}

Scene make_scene(const CylinderOptions& cylinder, const RoadOptions& road,
                 unsigned int angular_cells) {
  check_cylinder(cylinder);
  check_road(cylinder, road);

  Scene scene;
  const double unit = std::ldexp(1., std::ilogb(cylinder.outer_radius));
  scene.unit = unit;
  scene.inner_radius = cylinder.inner_radius / unit;
  scene.outer_radius = cylinder.outer_radius / unit;
  scene.angular_velocity = cylinder.angular_velocity * unit;
  scene.force_text = cylinder.radial_force;
  const std::optional<double> constant = constant_force(cylinder.radial_force);
  if (!constant)
    scene.force = [unit, f = parse_force(cylinder.radial_force,
                                         (cylinder.inner_radius + cylinder.outer_radius) / 2)](
                      double r, double z) { return unit * f(unit * r, z); };
  else if (*constant != 0) { // for 0 no load is ever assembled
    scene.uniform_force = unit * *constant;
    scene.force = [f = *scene.uniform_force](double, double) { return f; };
  }
  const double distance = scene.road_distance = road.distance / unit;
  scene.has_given_zone = road.contact_zone.has_value();
  scene.road = flat_road(scene.outer_radius, distance);
  scene.road_slope = flat_road_slope(distance);

  if (const auto& zone = road.contact_zone) {
    scene.zone_begin = zone->first;
    scene.zone_end = zone->second;
  } else {
    const double half_width = possible_half_width(scene, distance, angular_cells);
    scene.zone_begin = 3 * numbers::PI / 2 - half_width;
    scene.zone_end = 3 * numbers::PI / 2 + half_width;
  }
  return scene;
}

} // namespace rollwave
