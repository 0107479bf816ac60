#include "rollwave/output/surface_vtu.h"

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/numbers.h>

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
  patch.n_subdivisions = n_points - 1;
  patch.points_are_available = true; // behind the data
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

std::vector<double> angles_of_road(const Scene& scene, double radius) {
  const Road road = scene.road_at(scene.road_distance);
  const double half =
      std::min(road.crossing_angle(radius - scene.outer_radius), 0.499 * numbers::PI);
  constexpr unsigned int n = 500;
  std::vector<double> angles;
  for (unsigned int i = 0; i <= n; ++i)
    angles.push_back(numbers::PI * 3 / 2 + half * (2. * i / n - 1));
  return angles;
}

std::string surface_vtu(const Scene& scene, const Result& result) {
  const double length = scene.units.length, b = scene.outer_radius * length;
  std::vector<double> radius, angle, displacement, pressure, gap;
  const auto add = [&](const SurfacePoint& point) {
    const double z = point.angle, road = std::sin(z) < 0 ? scene.road(z) * length : b;
    radius.push_back(b + point.displacement);
    angle.push_back(z);
    displacement.push_back(point.displacement);
    pressure.push_back(pressure_at(result.contact_rows, z));
    gap.push_back(road < b ? road - point.displacement : std::numeric_limits<double>::quiet_NaN());
  };
  for (const SurfacePoint& point : result.surface)
    add(point);
  add({result.surface.front().angle + 2 * numbers::PI, result.surface.front().displacement});
  const auto name = [&scene](const std::string& field, Quantity quantity) {
    return field + scene.units.in_brackets(quantity);
  };
  return line_vtu(radius, {{name("angle", Quantity::angle), angle},
                           {name("displacement", Quantity::length), displacement},
                           {name("pressure", Quantity::pressure), pressure},
                           {name("gap", Quantity::length), gap}});
}

std::string road_vtu(const Scene& scene) {
  const std::vector<double> angles =
      angles_of_road(scene, 2 * std::max(scene.outer_radius, scene.road_distance));
  std::vector<double> radius;
  for (const double z : angles)
    radius.push_back((scene.outer_radius + scene.road(z)) * scene.units.length);
  return line_vtu(radius, {{"angle" + scene.units.in_brackets(Quantity::angle), angles}});
}

} // namespace rollwave
