#include "rollwave/output/surface_vtu.h"

#include "rollwave/scene/units.h"

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/numbers.h>
#include <deal.II/grid/reference_cell.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

namespace rollwave {

using namespace dealii;

namespace {

using Field = std::pair<std::string, std::vector<double>>; ///< by its name

/// A line through the points at @p radius over the angles that are the first of the @p fields.
std::string line_vtu(const std::vector<double>& radius, const std::vector<Field>& fields) {
  const std::vector<double>& angles = fields.front().second;
  const unsigned int n_fields = fields.size(), n_points = angles.size();
  DataOutBase::Patch<1, 2> patch;
  patch.reference_cell = ReferenceCells::Line;
  patch.n_subdivisions = n_points - 1;
  patch.points_are_available = true; // after the data
  patch.data.reinit(n_fields + 2, n_points);
  std::vector<std::string> names;
  for (const auto& [name, values] : fields) {
    for (unsigned int i = 0; i < n_points; ++i)
      patch.data(names.size(), i) = values[i];
    names.push_back(name);
  }
  for (unsigned int i = 0; i < n_points; ++i) {
    patch.data(n_fields, i) = radius[i] * std::cos(angles[i]);
    patch.data(n_fields + 1, i) = radius[i] * std::sin(angles[i]);
  }
  DataOutBase::VtkFlags flags;
  flags.print_date_and_time = false; // a run repeated gives the same file
  std::ostringstream out;
  DataOutBase::write_vtu<1, 2>({patch}, names, {}, flags, out);
  return out.str();
}

} // namespace

std::string surface_vtu(const Scene& scene, const Result& result) {
  const double length = scene.units.of(Quantity::length), b = scene.outer_radius,
               pressure_unit = scene.units.of(Quantity::pressure);
  std::vector<double> radius, angle, displacement, pressure, gap;
  const auto add = [&](const SurfacePoint& point, double turn) {
    const double z = point.angle,
                 road = scene.road.is_visible(from_lowest_point(z)) ? scene.phi(z) : b;
    radius.push_back((b + point.displacement) * length);
    angle.push_back(z + turn);
    displacement.push_back(point.displacement * length);
    pressure.push_back(point.pressure * pressure_unit);
    gap.push_back(road < b ? (road - point.displacement) * length
                           : std::numeric_limits<double>::quiet_NaN());
  };
  for (const SurfacePoint& point : result.surface)
    add(point, 0);
  add(result.surface.front(), 2 * numbers::PI); // which closes the line
  const auto name = [&scene](const std::string& field, Quantity quantity) {
    return field + scene.units.as_suffix(quantity);
  };
  return line_vtu(radius, {{name("angle", Quantity::angle), angle},
                           {name("displacement", Quantity::length), displacement},
                           {name("pressure", Quantity::pressure), pressure},
                           {name("gap", Quantity::length), gap}});
}

std::string road_vtu(const Scene& scene) {
  std::vector<double> radius, angles;
  for (const auto& [x, y] :
       scene.road.points(2 * std::max(scene.outer_radius, scene.road.distance))) {
    radius.push_back(std::hypot(x, y) * scene.units.length);
    angles.push_back(lowest_point + std::atan2(x, -y));
  }
  return line_vtu(radius, {{"angle" + scene.units.as_suffix(Quantity::angle), angles}});
}

} // namespace rollwave
