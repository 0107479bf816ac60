#include "rollwave/output/scene_plot.h"

#include "rollwave/base/text.h"
#include "rollwave/parameters/parameters.h"
#include "rollwave/run/quantities.h"
#include "rollwave/scene/expression.h"
#include "rollwave/scene/road.h"
#include "rollwave/scene/units.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

namespace rollwave {

namespace {

/// Half of the range of angles that is shown: 1.5 times the farther end of contact or, where less
/// than 1.5 rad remain, a little more than that end. Without contact the range shows the gap, and
/// has at least one node.
double shown_angle(const Scene& scene, const Result& result) {
  constexpr double most = 1.5; // a flat road is far away from there on
  if (!result.contact.ends) {
    double nearest = std::numeric_limits<double>::max(); // node to the lowest point
    for (const ContactRow& row : result.contact_rows)
      nearest = std::min(nearest, std::abs(from_lowest_point(row.angle)));
    return std::min(
        most, std::max({0.2, 3 * (scene.road.distance / scene.outer_radius - 1), 1.1 * nearest}));
  }
  const auto& [begin, end] = *result.contact.ends;
  const double farther =
      std::max(std::abs(from_lowest_point(begin)), std::abs(from_lowest_point(end)));
  return std::max(std::min(1.5 * farther, most), 1.02 * farther);
}

/// The length along the road, in the user's units, up to the angle @p x from the lowest point.
double abscissa(const Scene& scene, double x) {
  return scene.road.arc_length(x) * scene.units.length;
}

/// The scene, the material and the results, a line for each.
std::string title_of(const Scene& scene, const Parameters& parameters, const Result& result) {
  const Units& units = scene.units;
  constexpr int digits = 5;
  const auto in_units = [&](const std::string& name, double number, Quantity quantity) {
    return name + " = " + rounded(number * units.of(quantity), digits) + units.after(quantity);
  };
  std::string problem = in_units("a", scene.inner_radius, Quantity::length) + ", " +
                        in_units("b", scene.outer_radius, Quantity::length) + ", " +
                        in_units("c", scene.road.distance, Quantity::length) + ", ";
  if (scene.road.curvature != 0)
    problem += in_units("kappa", scene.road.curvature, Quantity::curvature) + ", ";
  problem += in_units("omega", scene.angular_velocity, Quantity::angular_velocity);
  if (scene.angular_velocity > 0)
    problem += " (" + rounded(scene.angular_velocity * scene.outer_radius, 3) + " critical)";
  const std::string& force = parameters.cylinder.radial_force;
  if (scene.force) {
    const auto number = value_if_any(force);
    problem += ", f = " + (number ? rounded(*number, digits) + units.after(Quantity::force_density)
                                  : printable(force, 60));
  }
  const MaterialOptions& material = units.material;
  if (material.is_given())
    problem += "\nmu = " + rounded(material.shear_modulus, digits) +
               units.after(Quantity::pressure) + ", rho = " + rounded(material.density, digits) +
               units.after(Quantity::density) + ", width = " + rounded(material.width, digits) +
               units.after(Quantity::length);
  std::string results;
  for (const auto& [words, name] : {std::pair("vertical load", "contact.vertical_load"),
                                    {"nip", "contact.length"},
                                    {"peak pressure", "contact.peak_pressure"}}) {
    const ResultQuantity& quantity = result_quantity(name);
    const auto value = quantity.in_users_units(result, units);
    if (value)
      results += std::string(words) + " = " + rounded(*value, digits) +
                 units.after(quantity.quantity) + ", ";
  }
  return problem + '\n' + results + 'Q' + std::to_string(result.mesh.degree) + ", " +
         (result.step_length ? "Uzawa" : "active set");
}

/// The data of the panels.
void write_data(std::ostream& script, const Scene& scene, const Result& result) {
  const double b = scene.outer_radius, length = scene.units.length,
               pressure_unit = scene.units.of(Quantity::pressure);
  const auto add_point = [&](double r, double z) {
    script << r * length * std::cos(z) << ' ' << r * length * std::sin(z) << '\n';
  };
  const auto add_surface = [&](const SurfacePoint& point) {
    add_point(std::max(0., b + point.displacement), point.angle); // not through the axle
  };
  script << "$surface << EOD\n";
  for (const SurfacePoint& point : result.surface)
    add_surface(point);
  add_surface(result.surface.front());
  script << "EOD\n$road << EOD\n";
  for (const auto& [x, y] :
       scene.road.points(4 * std::max(scene.outer_radius, scene.road.distance)))
    script << x * length << ' ' << y * length << '\n';
  script << "EOD\n$contact << EOD\n";
  for (const ContactRow& row : result.contact_rows)
    if (const double x = from_lowest_point(row.angle); std::abs(x) <= scene.road.tangent_angle())
      script << abscissa(scene, x) << ' ' << std::max(0., row.gap * length) << ' '
             << row.pressure * pressure_unit << '\n';
  script << "EOD\n";
}

/// gnuplot's commands for the whole scene and for the surroundings of the contact, with the same
/// scale in x and y.
const char* const pictures = R"(
set style line 1 linewidth 2.5 linecolor rgb '#1f5fa8'
set style line 2 linewidth 1.5 dashtype 2 linecolor rgb '#707070'
set style line 3 linewidth 2.5 linecolor rgb '#4a3818'
set style line 4 linewidth 1.5 linecolor rgb '#000000'
set parametric
set samples 361
set tics font ',12'
set trange [0:2*pi]
set size ratio -1 0.5,0.91
set origin 0,0
set xrange [-half:half]
set yrange [-half:half]
set xlabel 'x'.unit offset 0,0.6
set ylabel 'y'.unit offset 1
set key below horizontal
plot '$road' using 1:2 with filledcurves @road_side fillcolor rgb '#c4b89c' notitle, \
     '$surface' using 1:2 with filledcurves closed fillcolor rgb '#dbe7f3' notitle, \
     b*cos(t),b*sin(t) with lines linestyle 2 title 'undeformed', \
     '$surface' using 1:2 with lines linestyle 1 title 'deformed', \
     a*cos(t),a*sin(t) with filledcurves closed fillcolor rgb '#ffffff' notitle, \
     a*cos(t),a*sin(t) with lines linestyle 4 title 'hub', \
     '$road' using 1:2 with lines linestyle 3 title 'road', \
     NaN,NaN with lines dashtype 3 linewidth 1.5 linecolor black title ends
unset key
set lmargin at screen 0.58
set rmargin at screen 0.98
set tmargin at screen 0.89
set bmargin at screen 0.64
set size noratio
set trange [1.5*pi-1.5*zoom/b:1.5*pi+1.5*zoom/b]
set xrange [-zoom:zoom]
set yrange [-c-0.36*height:-c+0.64*height]
set format '%g'
set ylabel offset 0
plot '$surface' using 1:2 with filledcurves y1=0 fillcolor rgb '#dbe7f3', \
     '$road' using 1:2 with filledcurves @road_side fillcolor rgb '#c4b89c', \
     b*cos(t),b*sin(t) with lines linestyle 2, \
     '$surface' using 1:2 with lines linestyle 1, \
     '$road' using 1:2 with lines linestyle 3
unset parametric
)";

/// Gap and pressure along the road.
const char* const gap = R"(
set xrange [-range:range]
set tmargin at screen 0.55
set bmargin at screen 0.36
set yrange [0:*]
set ytics font ',10'
set ylabel 'gap'.unit offset -1
set xlabel ''
set format x ''
plot '$contact' using 1:2 with lines linestyle 3
)";
const char* const pressure = R"(
set tmargin at screen 0.31
set bmargin at screen 0.11
set format x '%g'
set xlabel abscissa
plot '$contact' using 1:3 with filledcurves y1=0 fillcolor rgb '#f3d9c4', \
     '$contact' using 1:3 with lines linestyle 1 linecolor rgb '#b3541e'
)";

} // namespace

Picture plot_scene(const Scene& scene, const Parameters& parameters, const Result& result) {
  constexpr unsigned int width = 1100, height = 690;
  // The frame of the zoom has 0.40 of the width and 0.25 of the height.
  const double ratio = (0.25 * height) / (0.40 * width), angle = shown_angle(scene, result),
               zoom = std::min(1., angle);
  std::ostringstream script;
  script.precision(12);
  write_data(script, scene, result);
  double largest = 0;
  for (const SurfacePoint& point : result.surface)
    largest = std::max(largest, 1 + point.displacement / scene.outer_radius);
  const double b = scene.outer_radius, length = scene.units.length;
  const std::string unit = scene.units.in_brackets(Quantity::length);
  script << "a = " << scene.inner_radius * length << "\nb = " << b * length
         << "\nc = " << scene.road.distance * length << "\nhalf = 1.08 * b * "
         << std::max(1.15, largest)
         << "\nrange = " << abscissa(scene, std::min(angle, scene.road.tangent_angle()))
         << "\nabscissa = " << in_single_quotes("length along the road" + unit) << "\nzoom = b * "
         << zoom << "\nheight = 2 * zoom * " << ratio << "\nunit = " << in_single_quotes(unit)
         << "\nends = '" << (result.contact.ends ? "ends of contact" : "")
         << "'\nroad_side = " << (scene.road.is_convex() ? "'closed'" : "sprintf('y1=%g', -10*b)")
         << "\nset multiplot title "
         << title_in_room(title_of(scene, parameters, result), width).text << '\n'
         << pictures << set_grid;
  for (const ContactPatch& patch : result.contact.patches)
    for (const double z : {patch.begin, patch.end})
      script << "set arrow from " << abscissa(scene, from_lowest_point(z))
             << ",graph 0 rto 0,graph 1"
             << " nohead dashtype 3 linewidth 1.5\n";
  script << gap;
  if (!result.contact.ends)
    script << "set yrange [0:1]\nset label 'no contact' at graph 0.5,0.5 center\n";
  script << "set ylabel "
         << in_single_quotes("pressure" + scene.units.in_brackets(Quantity::pressure))
         << " offset -1\n"
         << pressure << "unset multiplot\n";
  return {"scene", script.str(), width, height};
}

} // namespace rollwave
