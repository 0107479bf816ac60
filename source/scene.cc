#include "scene.h"

#include "contact_free.h"
#include "declarations.h"
#include "errors.h"
#include "parameters.h"

#include <deal.II/base/function_parser.h>
#include <deal.II/base/numbers.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <sstream>

namespace rollwave {

using namespace dealii;

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

namespace {

template <typename... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::digits10);
  (out << ... << parts);
  return out.str();
}

/// Refuses radii and a speed for which the problem is not posed, or not elliptic.
void check_cylinder(const Parameters& parameters) {
  const auto& cylinder = parameters.cylinder;
  const auto refuse = [&](const std::string& key, const std::string& wanted) {
    throw BadInput(refusal(parameters.settings, "Cylinder", key, wanted));
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

void check_road(const Parameters& parameters) {
  const double b = parameters.cylinder.outer_radius;
  const double c = parameters.road.distance;
  const auto refuse = [&](const std::string& key, const std::string& wanted) {
    throw BadInput(refusal(parameters.settings, "Road", key, wanted));
  };
  if (!(c > parameters.cylinder.inner_radius))
    refuse("Distance", text("the road reaches the hub; it must be greater than the inner radius ",
                            parameters.cylinder.inner_radius));
  if (const auto& zone = parameters.road.contact_zone) {
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

/// What needs the certificate is refused without it.
void check_certificate(const Parameters& parameters) {
  if (parameters.certificate.error_bound)
    return;
  if (parameters.certificate.load_bounds)
    throw BadInput(refusal(parameters.settings, "Certificate", "Load bounds",
                           "they need the error bound; set Certificate/Error bound = true"));
  if (parameters.mesh.wanted_relative_error > 0)
    throw BadInput(refusal(parameters.settings, "Mesh", "Wanted relative error",
                           "it is judged by the certificate; set Certificate/Error bound = true"));
}

/// Keeps what is written to std::cerr while it lives: deal.II prints the parser's complaints there.
class CapturedErrors {
public:
  CapturedErrors() : original(std::cerr.rdbuf(captured.rdbuf())) {}
  ~CapturedErrors() { std::cerr.rdbuf(original); }
  CapturedErrors(const CapturedErrors&) = delete;
  CapturedErrors& operator=(const CapturedErrors&) = delete;

  /// The rest of the first line that has @p label; empty without one.
  std::string line_after(const std::string& label) const {
    const std::string all = captured.str();
    const auto found = all.find(label);
    if (found == std::string::npos)
      return {};
    const auto begin = found + label.size();
    return trimmed(all.substr(begin, all.find('\n', begin) - begin));
  }

private:
  std::ostringstream captured;
  std::streambuf* original;
};

/// f when it is given as a number.
std::optional<double> constant_force(const Parameters& parameters) {
  try {
    return to_number(parameters.cylinder.radial_force);
  } catch (const std::invalid_argument&) {
    return {};
  }
}

/// Why @p expression is no function of r and z although the parser would give it a value: of "1,5"
/// the last part, 5, of "3;" the first. Empty where it would not.
std::string misunderstanding(const std::string& expression) {
  int depth = 0;
  for (std::size_t i = 0; i < expression.size(); ++i) {
    const char c = expression[i];
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == ',' && depth == 0)
      return "A comma separates the arguments of a function; decimals have a point.";
    if (c == ';')
      return "A semicolon separates expressions, of which there is one.";
    const bool is_comparison =
        expression.compare(i, 2, "==") == 0 ||
        (i > 0 && std::string("=<>!").find(expression[i - 1]) != std::string::npos);
    if (c == '=' && !is_comparison)
      return "r and z cannot be assigned to.";
  }
  return expression.find("rand") == std::string::npos
             ? ""
             : "A random number is no function of r and z.";
}

/// f as a function of r and z.
std::function<double(double, double)> parse_force(const Parameters& parameters) {
  const std::string& expression = parameters.cylinder.radial_force;
  const auto refuse = [&](const std::string& why) {
    throw BadInput(
        refusal(parameters.settings, "Cylinder", "Radial force",
                "it must be an expression in r and z, as in 1 + 0.5*r*cos(z). " + printable(why)));
  };
  if (const std::string why = misunderstanding(expression); !why.empty())
    refuse(why);
  auto parser = std::make_shared<FunctionParser<2>>(1);
  const auto force = [parser](double r, double z) { return parser->value(Point<2>(r, z)); };
  double middle = 0;
  const CapturedErrors captured;
  try {
    parser->initialize("r,z", expression, {{"pi", numbers::PI}});
    middle = force((parameters.cylinder.inner_radius + parameters.cylinder.outer_radius) / 2,
                   numbers::PI);
  } catch (const std::exception&) {
    refuse(captured.line_after("Message:"));
  }
  if (!std::isfinite(middle))
    throw BadInput(refusal(parameters.settings, "Cylinder", "Radial force",
                           "it must be finite everywhere between the radii"));
  return force;
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
  text << scene.force_refusal << " at r = " << r * scene.unit << ", z = " << z;
  return text.str();
}

Scene make_scene(const Parameters& parameters) {
  check_certificate(parameters);
  check_cylinder(parameters);
  check_road(parameters);

  Scene scene;
  const double unit = std::ldexp(1., std::ilogb(parameters.cylinder.outer_radius));
  scene.unit = unit;
  scene.inner_radius = parameters.cylinder.inner_radius / unit;
  scene.outer_radius = parameters.cylinder.outer_radius / unit;
  scene.angular_velocity = parameters.cylinder.angular_velocity * unit;
  scene.force_refusal =
      refusal(parameters.settings, "Cylinder", "Radial force", "it is not finite");
  scene.force_text = parameters.cylinder.radial_force;
  const std::optional<double> constant = constant_force(parameters);
  if (!constant)
    scene.force = [unit, f = parse_force(parameters)](double r, double z) {
      return unit * f(unit * r, z);
    };
  else if (*constant != 0) { // for 0 no load is ever assembled
    scene.uniform_force = unit * *constant;
    scene.force = [f = *scene.uniform_force](double, double) { return f; };
  }
  const double distance = parameters.road.distance / unit;
  scene.road = flat_road(scene.outer_radius, distance);
  scene.road_slope = flat_road_slope(distance);

  if (const auto& zone = parameters.road.contact_zone) {
    scene.zone_begin = zone->first;
    scene.zone_end = zone->second;
  } else {
    const double half_width = possible_half_width(scene, distance, parameters.mesh.angular_cells);
    scene.zone_begin = 3 * numbers::PI / 2 - half_width;
    scene.zone_end = 3 * numbers::PI / 2 + half_width;
  }
  return scene;
}

} // namespace rollwave
