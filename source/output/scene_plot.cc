#include "rollwave/output/scene_plot.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace rollwave {

Drawing plot_scene(const Scene& scene, const Result& result) {
  // Lengths are drawn in units of b, so that any scene fits the frame.
  const double b = scene.outer_radius;
  std::ostringstream script;
  script.precision(12);
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
  // The contact with half as much on both sides, as far as the zone goes.
  double begin = scene.zone_begin, end = scene.zone_end;
  if (result.patch.ends) {
    begin = std::max(begin, result.patch.ends->first - result.patch.half_width());
    end = std::min(end, result.patch.ends->second + result.patch.half_width());
  }
  const auto is_within = [=](const ContactRow& row) {
    return begin <= row.angle && row.angle <= end;
  };
  const auto& rows = result.contact_rows;
  const bool is_any_within = std::any_of(rows.begin(), rows.end(), is_within);
  // The undeformed surface is in view, and of the road what is nearest to it.
  double least = 0, nearest_road = std::numeric_limits<double>::max(), largest = -nearest_road;
  const double lowest_point = 3 * dealii::numbers::PI / 2;
  script << "$contact << EOD\n";
  for (const ContactRow& row : rows) {
    const double u = row.displacement / b, road = row.road / b;
    script << row.angle - lowest_point << ' ' << u << ' ' << road << ' ' << row.pressure << '\n';
    if (is_any_within && !is_within(row))
      continue;
    least = std::min({least, u, road});
    largest = std::max(largest, u);
    nearest_road = std::min(nearest_road, road);
  }
  script << "EOD\n";
  largest = std::max(largest, nearest_road);
  const double margin = largest > least ? (largest - least) / 8 : 1;

  script << "a = " << scene.inner_radius / b << "\nhalf = " << 1.08 * largest_radius
         << "\nc = " << scene.road_distance / b << '\n'
         << R"(
set multiplot
set samples 361
set parametric
set trange [0:2*pi]
set size ratio -1 1,0.55
set origin 0,0.45
set xrange [-half:half]
set yrange [-half:half]
set xlabel 'x / b'
set ylabel 'y / b'
set key outside bottom center horizontal
set object 1 rectangle from -half,-half to half,-c fillcolor rgb '#e8e4dc' fillstyle solid noborder behind
plot '$surface' using 1:2 with filledcurves closed fillcolor rgb '#dbe7f3' notitle, \
     cos(t),sin(t) with lines linewidth 1 dashtype 2 linecolor rgb '#808080' title 'undeformed', \
     '$surface' using 1:2 with lines linewidth 2 linecolor rgb '#1f5fa8' title 'deformed', \
     a*cos(t),a*sin(t) with filledcurves closed fillcolor rgb '#ffffff' notitle, \
     a*cos(t),a*sin(t) with lines linewidth 2 linecolor rgb '#404040' title 'hub', \
     half*(t/pi-1),-c with lines linewidth 2 linecolor rgb '#7a5c2e' title 'road'
unset parametric
unset object 1
set size noratio
set lmargin at screen 0.17
set rmargin at screen 0.96
set key inside bottom center
unset xlabel
set format '%g'
set grid
)";
  script << "set xrange [" << begin - lowest_point << ':' << end - lowest_point << "]\n";
  if (const auto& ends = result.patch.ends)
    for (const double z : {ends->first, ends->second})
      script << "set arrow from " << z - lowest_point << ",graph 0 to " << z - lowest_point
             << ",graph 1 nohead dashtype 3\n";
  // Outwards is downwards, as in the picture above.
  script << "lowest = " << largest + margin << "\nset yrange [lowest:" << least - margin << "]\n"
         << R"(
set size 1,0.23
set origin 0,0.23
set ylabel 'displacement / b'
plot '$contact' using 1:3 with filledcurves y1=lowest fillcolor rgb '#e8e4dc' notitle, \
     '$contact' using 1:3 with lines linewidth 2 linecolor rgb '#7a5c2e' title 'road', \
     '$contact' using 1:2 with lines linewidth 2 linecolor rgb '#1f5fa8' title 'surface'
set origin 0,0
set yrange [0:*]
set xlabel 'angle from the lowest point, z - 3 pi / 2 [rad]'
set ylabel 'contact pressure'
)";
  if (!result.patch.ends)
    script << "set yrange [0:1]\nset label 1 'no contact' at graph 0.5,0.5 center\n";
  script << "plot '$contact' using 1:4 with filledcurves y1=0 fillcolor rgb '#f3d9c4' notitle, "
            "'$contact' using 1:4 with lines linewidth 2 linecolor rgb '#b3541e' notitle\n";
  return Drawing(script.str(), 760, 1200);
}

} // namespace rollwave
