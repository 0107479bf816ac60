#include "rollwave/output/scene_plot.h"

#include "rollwave/output/surface_vtu.h"
#include "rollwave/scene/road.h"
#include "rollwave/scene/units.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace rollwave {

namespace {

/// Half the width of the zoom, in units of b: the contact and half as much on both sides, or the
/// gap.
double zoom_of(const Scene& scene, const Result& result) {
  const double gap = scene.road.distance / scene.outer_radius - 1;
  if (!result.patch.ends)
    return std::max(0.2, 3 * gap);
  return 1.5 * std::max(std::abs(from_lowest_point(result.patch.ends->first)),
                        std::abs(from_lowest_point(result.patch.ends->second)));
}

std::string title_of(const Scene& scene, const Result& result) {
  const double b = scene.outer_radius;
  const bool is_given = scene.units.material.is_given();
  std::ostringstream title;
  title.precision(4);
  title << (result.rho > 0 ? "Uzawa" : "active set") << ", Q" << result.mesh.degree << ":  "
        << (is_given ? "omega / critical = " : "omega b = ") << scene.angular_velocity * b
        << ",  c / b = " << scene.road.distance / b << ",  a / b = " << scene.inner_radius / b;
  if (is_given)
    title << ",  F = " << result.patch.force * scene.units.of(Quantity::force)
          << scene.units.after(Quantity::force);
  else
    title << ",  F / b = " << result.patch.force / b;
  if (scene.road.curvature != 0)
    title << ",  kappa b = " << scene.road.curvature * b;
  return title.str();
}

std::string pressure_unit(const Units& units) {
  const std::string name = units.in_brackets(Quantity::pressure);
  return name.empty() && units.material.shear_modulus == 1 ? " / modulus" : name;
}

/// The data of the panels, lengths in units of b, so that any scene fits the frames.
void write_data(std::ostream& script, const Scene& scene, const Result& result) {
  const double b = scene.outer_radius, pressure_unit = scene.units.of(Quantity::pressure);
  const auto add_point = [&](double r, double z) {
    script << r * std::cos(z) << ' ' << r * std::sin(z) << '\n';
  };
  const auto add_surface = [&](const SurfacePoint& point) {
    add_point(std::max(0., 1 + point.displacement / b), point.angle); // not through the axle
  };
  script << "$surface << EOD\n";
  for (const SurfacePoint& point : result.surface)
    add_surface(point);
  add_surface(result.surface.front());
  script << "EOD\n$road << EOD\n";
  for (const auto& [x, y] :
       points_of_road(scene, 4 * std::max(scene.outer_radius, scene.road.distance)))
    script << x / scene.outer_radius << ' ' << y / scene.outer_radius << '\n';
  script << "EOD\n$contact << EOD\n";
  for (const ContactRow& row : result.contact_rows)
    script << from_lowest_point(row.angle) << ' ' << std::max(0., row.gap / b) << ' '
           << row.pressure * pressure_unit << '\n';
  script << "EOD\n";
}

/// The scene, and at the same scale in x and y what is around the contact.
const char* const pictures = R"(
set style line 1 linewidth 2.5 linecolor rgb '#1f5fa8'
set style line 2 linewidth 1.5 dashtype 2 linecolor rgb '#707070'
set style line 3 linewidth 2.5 linecolor rgb '#4a3818'
set style line 4 linewidth 1.5 linecolor rgb '#000000'
set parametric
set samples 361
set tics font ',12'
set trange [0:2*pi]
set size ratio -1 0.5,0.94
set origin 0,0
set xrange [-half:half]
set yrange [-half:half]
set xlabel 'x / b' offset 0,0.6
set ylabel 'y / b' offset 1
set key below horizontal
plot '$road' using 1:2 with filledcurves @road_side fillcolor rgb '#c4b89c' notitle, \
     '$surface' using 1:2 with filledcurves closed fillcolor rgb '#dbe7f3' notitle, \
     cos(t),sin(t) with lines linestyle 2 title 'undeformed', \
     '$surface' using 1:2 with lines linestyle 1 title 'deformed', \
     a*cos(t),a*sin(t) with filledcurves closed fillcolor rgb '#ffffff' notitle, \
     a*cos(t),a*sin(t) with lines linestyle 4 title 'hub', \
     '$road' using 1:2 with lines linestyle 3 title 'road'
unset key
set lmargin at screen 0.58
set rmargin at screen 0.98
set tmargin at screen 0.93
set bmargin at screen 0.68
set size noratio
set trange [1.5*pi-1.5*zoom:1.5*pi+1.5*zoom]
set xrange [-zoom:zoom]
set yrange [-c-0.36*height:-c+0.64*height]
set format '%g'
plot '$surface' using 1:2 with filledcurves y1=0 fillcolor rgb '#dbe7f3', \
     '$road' using 1:2 with filledcurves @road_side fillcolor rgb '#c4b89c', \
     cos(t),sin(t) with lines linestyle 2, \
     '$surface' using 1:2 with lines linestyle 1, \
     '$road' using 1:2 with lines linestyle 3
unset parametric
set grid
)";

/// Gap and pressure over the angle.
const char* const gap = R"(
set xrange [-angle:angle]
set tmargin at screen 0.58
set bmargin at screen 0.37
set yrange [0:*]
set ylabel 'gap / b'
set xlabel ''
set format x ''
plot '$contact' using 1:2 with lines linestyle 3
)";
const char* const pressure = R"(
set tmargin at screen 0.32
set bmargin at screen 0.11
set format x '%g'
set xlabel '(z - 3 pi / 2) / rad'
plot '$contact' using 1:3 with filledcurves y1=0 fillcolor rgb '#f3d9c4', \
     '$contact' using 1:3 with lines linestyle 1 linecolor rgb '#b3541e'
)";

} // namespace

Picture plot_scene(const Scene& scene, const Result& result) {
  constexpr unsigned int width = 1100, height = 640;
  const double zoom = zoom_of(scene, result);
  // Of the frame of the zoom, which has 0.40 of the width and 0.25 of the height.
  const double ratio = (0.25 * height) / (0.40 * width);
  std::ostringstream script;
  script.precision(12);
  write_data(script, scene, result);
  double largest = 0;
  for (const SurfacePoint& point : result.surface)
    largest = std::max(largest, 1 + point.displacement / scene.outer_radius);
  script << "a = " << scene.inner_radius / scene.outer_radius
         << "\nc = " << scene.road.distance / scene.outer_radius << "\nhalf = 1.08 * "
         << std::max(1.15, largest) << "\nzoom = " << zoom << "\nangle = " << std::min(zoom, 1.5)
         << "\nroad_side = '" << (scene.road.curvature > 0 ? "closed" : "y1=-10")
         << "'\nheight = " << 2 * zoom * ratio << "\nset multiplot title '"
         << title_of(scene, result) << "'\n"
         << pictures;
  for (const ContactPatch& patch : result.patch.patches)
    for (const double z : {patch.begin, patch.end})
      script << "set arrow from " << from_lowest_point(z) << ",graph 0 to " << from_lowest_point(z)
             << ",graph 1 nohead dashtype 3 linewidth 1.5\n";
  script << gap;
  if (!result.patch.ends)
    script << "set yrange [0:1]\nset label 'no contact' at graph 0.5,0.5 center\n";
  script << "set ylabel " << in_single_quotes("pressure" + pressure_unit(scene.units)) << '\n'
         << pressure << "unset multiplot\n";
  return {script.str(), width, height};
}

} // namespace rollwave
