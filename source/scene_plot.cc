#include "scene_plot.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace rollwave {

Drawing plot_scene(const Scene& scene, const Parameters& parameters, const Result& result) {
  // Lengths are drawn in units of b, so that any scene fits the frame.
  const double b = scene.outer_radius;
  std::ostringstream script;
  script.precision(9);
  script << "$surface << EOD\n";
  double largest_radius = 1.25;
  const auto add_point = [&](const SurfacePoint& point) {
    const double r = std::max(0., 1 + point.displacement / b); // not through the axle
    script << r * std::cos(point.angle) << ' ' << r * std::sin(point.angle) << '\n';
    largest_radius = std::max(largest_radius, r);
  };
  for (const SurfacePoint& point : result.surface)
    add_point(point);
  add_point(result.surface.front());
  script << "EOD\n";
  script << "$pressure << EOD\n";
  for (const ContactRow& row : result.contact_rows)
    script << row.angle << ' ' << row.pressure << '\n';
  script << "EOD\n";

  script << "a = " << scene.inner_radius / b << "\nhalf = " << 1.08 * largest_radius
         << "\nc = " << parameters.road.distance / parameters.cylinder.outer_radius << '\n'
         << R"(
set multiplot
set samples 361
set parametric
set trange [0:2*pi]
set size ratio -1 1,0.68
set origin 0,0.32
set xrange [-half:half]
set yrange [-half+0.1:half-0.2]
set xlabel 'x / b'
set ylabel 'y / b'
set key outside right top
set object 1 rectangle from -half,-half+0.1 to half,-c fillcolor rgb '#e8e4dc' fillstyle solid noborder behind
plot '$surface' using 1:2 with filledcurves closed fillcolor rgb '#dbe7f3' notitle, \
     cos(t),sin(t) with lines linewidth 1 dashtype 2 linecolor rgb '#808080' title 'undeformed', \
     '$surface' using 1:2 with lines linewidth 2 linecolor rgb '#1f5fa8' title 'deformed', \
     a*cos(t),a*sin(t) with filledcurves closed fillcolor rgb '#ffffff' notitle, \
     a*cos(t),a*sin(t) with lines linewidth 2 linecolor rgb '#404040' title 'hub', \
     half*(t/pi-1),-c with lines linewidth 2 linecolor rgb '#7a5c2e' title 'road'
unset parametric
unset object 1
set size noratio
set size 1,0.33
set origin 0,0
set key inside right top
set autoscale
set yrange [0:*]
set xlabel 'angle z [rad], lowest point at 3 pi / 2'
set ylabel 'pressure'
set format y '%g'
set grid
)";
  if (result.patch.ends)
    script << "set arrow 1 from " << result.patch.ends->first << ",graph 0 to "
           << result.patch.ends->first << ",graph 1 nohead dashtype 3\nset arrow 2 from "
           << result.patch.ends->second << ",graph 0 to " << result.patch.ends->second
           << ",graph 1 nohead dashtype 3\n";
  else
    script << "set yrange [0:1]\nset label 1 'no contact' at graph 0.5,0.5 center\n";
  script << "set xrange [" << scene.zone_begin << ':' << scene.zone_end << "]\n"
         << "plot '$pressure' using 1:2 with filledcurves y1=0 fillcolor rgb '#f3d9c4' notitle, "
            "'$pressure' using 1:2 with lines linewidth 2 linecolor rgb '#b3541e' "
            "title 'contact pressure'\n";
  return Drawing(script.str(), 760, 980);
}

} // namespace rollwave
