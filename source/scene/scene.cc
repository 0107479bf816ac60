#include "rollwave/scene/scene.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/text.h"
#include "rollwave/scene/expression.h"
#include "rollwave/scene/road.h"
#include "rollwave/scene/uniform_force.h"
#include "rollwave/scene/units.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

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

/// True if a user who has read @p exact on the screen, or has computed it, may have written the
/// larger @p number: it is rounded to six digits or more.
bool is_rounding_of(double number, double exact) {
  if (number <= exact * (1 + 4 * std::numeric_limits<double>::epsilon()))
    return true;
  for (int digits = 6; digits <= std::numeric_limits<double>::digits10; ++digits)
    if (to_number(rounded(exact, digits)) == number)
      return true;
  return false;
}

/// Refuses radii and a speed for which the problem is not posed, or not elliptic.
void check_cylinder(const CylinderOptions& cylinder, const MaterialOptions& material) {
  const auto refuse = [&](const std::string& key, const std::string& wanted) {
    throw BadValue("Cylinder", key, wanted);
  };
  if (!(cylinder.outer_radius > cylinder.inner_radius))
    refuse("Outer radius",
           text("it must be greater than the inner radius ", cylinder.inner_radius));

  constexpr double least_ratio = 1e-150; // its square does not underflow
  if (cylinder.inner_radius < least_ratio * cylinder.outer_radius)
    refuse("Inner radius", text("it must be at least ", least_ratio, " of the outer radius"));

  const double critical = critical_speed(cylinder, material);
  if (cylinder.angular_velocity > critical && !is_rounding_of(cylinder.angular_velocity, critical))
    refuse("Angular velocity",
           text("it must be at most the critical speed (mu/rho)^(1/2)/b = ", critical,
                ", beyond which the problem is not elliptic",
                material.is_given()
                    ? "; Material/Shear modulus and Density must be in consistent units"
                    : "; without section Material, mu and rho are 1"));
}

void check_road(const CylinderOptions& cylinder, const RoadOptions& road, double c) {
  const double b = cylinder.outer_radius;
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
  if (road.curvature < 0 && -1 / road.curvature <= std::max(b, c))
    refuse("Curvature", text("the road is the inside of a drum of the radius ", -1 / road.curvature,
                             ", which must be larger than the cylinder and the distance"));
  // Seen from the axle, a drum has an angle of about 1 / (kappa b). Angles of a
  // mesh are known to angular_round_off, which must stay below a thousandth of that.
  const double most_curvature = 1e-3 / angular_round_off / b;
  if (road.curvature > most_curvature)
    refuse("Curvature", text("the drum is too thin for the accuracy of angles; it must be at most ",
                             most_curvature));
}

/// Half the angle in which the surface can touch the road; pi stands for the whole circle. Contact
/// pushes inwards, so that u <= u_f, the displacement without contact: where the force is uniform,
/// contact ends before phi = u_f. Two cells are added, since contact that ends within a cell is
/// felt next to it. For a force expression u_f is not known, and the zone is where phi < b. No zone
/// is wider than that.
double possible_half_width(const Scene& scene, unsigned int angular_cells) {
  const double a = scene.inner_radius, b = scene.outer_radius;
  double limit = b, margin = 0; // of phi and of the angle
  if (!scene.force.is_expression()) {
    limit = std::min(b, scene.force.uniform.value_or(0) * contact_free_unit_displacement(a, b, b));
    margin = 4 * numbers::PI / angular_cells;
  }
  // For a given load, the nearest road has the widest contact. Inside of a drum that the surface
  // can fill, all of the surface can touch.
  if (!scene.has_distance() && b + limit >= scene.road.greatest_distance())
    return numbers::PI;
  const Road road = scene.has_distance() ? scene.road : scene.road.at(scene.least_distance);
  return std::min({numbers::PI, road.crossing_angle(b), road.crossing_angle(limit) + margin});
}

/// f as a function of r and z in the user's units. @throws BadValue
std::function<double(double r, double z)> parse_force(const CylinderOptions& cylinder) {
  try {
    return parse_function(cylinder.radial_force,
                          (cylinder.inner_radius + cylinder.outer_radius) / 2);
  } catch (const std::invalid_argument& error) {
    throw BadValue(
        "Cylinder", "Radial force",
        text("it must be a finite expression in r and z, as in 1 + 0.5*r*cos(z). ", error.what()));
  }
}

BodyForce make_force(const CylinderOptions& cylinder, const Units& units) {
  const double density = units.of(Quantity::force_density);
  BodyForce force;
  const std::optional<double> uniform = value_if_any(cylinder.radial_force);
  if (!uniform)
    force.density = [unit = units.length, density, f = parse_force(cylinder)](double r, double z) {
      return f(unit * r, z) / density;
    };
  else if (*uniform != 0) // for 0 no load is ever assembled
    force.uniform = *uniform / density;
  return force;
}

} // namespace

double critical_speed(const CylinderOptions& cylinder, const MaterialOptions& material) {
  return material.wave_speed() / cylinder.outer_radius;
}

std::string force_not_finite_at(const Scene& scene, double r, double z) {
  std::ostringstream text;
  text << "it is not finite at r = " << r * scene.units.length << ", z = " << z;
  return text.str();
}

Scene with_distance(Scene scene, double c) {
  scene.road.distance = c;
  scene.phi = make_obstacle(scene.road);
  return scene;
}

Scene calibrated(Scene scene, double ratio) {
  scene.units.material.shear_modulus *= ratio;
  scene.units.material.density *= ratio;
  if (scene.load)
    scene.load->value /= ratio;
  return scene;
}

Scene scaled_scene(const CylinderOptions& cylinder, const RoadOptions& road,
                   const MaterialOptions& material, unsigned int angular_cells) {
  check_cylinder(cylinder, material);
  const double a = cylinder.inner_radius, b = cylinder.outer_radius;
  const double least_distance = std::max(a, 0.05 * b); // for a given load or nip
  const double distance =
      !road.has_distance() ? least_distance + (b - least_distance) / 2 : road.distance;
  check_road(cylinder, road, distance);

  Scene scene;
  const double unit = std::ldexp(1., std::ilogb(b));
  scene.units = {unit, material};
  scene.inner_radius = a / unit;
  scene.outer_radius = b / unit;
  // Takes off what check_cylinder() tolerates above 1/b, so that alpha(b) >= 0.
  scene.angular_velocity =
      std::min(cylinder.angular_velocity / scene.units.of(Quantity::angular_velocity),
               1 / scene.outer_radius);
  scene.force = make_force(cylinder, scene.units);
  scene.has_given_zone = road.contact_zone.has_value();
  scene.road = {scene.outer_radius, distance / unit, road.curvature * unit};
  scene.least_distance = least_distance / unit;
  if (road.load)
    scene.load = Scene::Load{*road.load / scene.units.of(Quantity::force), road.load_kind};
  if (road.nip)
    scene.nip = *road.nip / unit;
  if (scene.load && scene.nip && scene.force)
    throw BadValue(
        "Road", "Nip",
        "load and nip calibrate the shear modulus where Cylinder/Radial force is 0 only: "
        "the load is then proportional to it");
  scene.phi = make_obstacle(scene.road);

  if (const auto& zone = road.contact_zone) {
    scene.zone_begin = zone->first;
    scene.zone_end = zone->second;
  } else {
    const double half_width = possible_half_width(scene, angular_cells);
    scene.zone_begin = lowest_point - half_width;
    scene.zone_end = lowest_point + half_width;
  }
  return scene;
}

} // namespace rollwave
