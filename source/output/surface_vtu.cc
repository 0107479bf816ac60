#include "rollwave/output/surface_vtu.h"

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

namespace rollwave {

namespace {

using Field = std::pair<std::string, std::vector<double>>; ///< by its name

/// An array of VTK's XML in its binary form, the only one that can hold what is not a number.
template <typename Number>
std::string data_array(const std::string& type, const std::string& name, unsigned int n_components,
                       const std::vector<Number>& values) {
  const std::uint32_t n_bytes = values.size() * sizeof(Number);
  std::vector<unsigned char> bytes(sizeof(n_bytes) + n_bytes);
  std::memcpy(bytes.data(), &n_bytes, sizeof(n_bytes));
  std::memcpy(bytes.data() + sizeof(n_bytes), values.data(), n_bytes);
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
         std::to_string(n_components) + "\" format=\"binary\">" +
         dealii::Utilities::encode_base64(bytes) + "</DataArray>\n";
}

/// A line through the points at @p radius over the angles that are the first of the @p fields.
std::string line_vtu(const std::vector<double>& radius, const std::vector<Field>& fields) {
  const std::vector<double>& angles = fields.front().second;
  std::vector<double> points;
  std::vector<std::int64_t> numbers;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    points.insert(points.end(),
                  {radius[i] * std::cos(angles[i]), radius[i] * std::sin(angles[i]), 0.});
    numbers.push_back(i);
  }
  const std::vector<std::int64_t> end = {static_cast<std::int64_t>(numbers.size())};
  constexpr unsigned char poly_line = 4; // VTK's number
  std::ostringstream out;
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\""
      << angles.size() << "\" NumberOfCells=\"1\">\n<Points>\n"
      << data_array("Float64", "points", 3, points) << "</Points>\n<Cells>\n"
      << data_array("Int64", "connectivity", 1, numbers) << data_array("Int64", "offsets", 1, end)
      << data_array("UInt8", "types", 1, std::vector<unsigned char>{poly_line})
      << "</Cells>\n<PointData>\n";
  for (const auto& [name, values] : fields)
    out << data_array("Float64", name, 1, values);
  out << "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  return out.str();
}

} // namespace

std::vector<std::pair<double, double>> points_of_road(const Scene& scene, double longest) {
  const double kappa = scene.road_curvature, c = scene.road_distance;
  const double most = dealii::numbers::PI * (kappa > 0 ? 1 : 0.5);
  const double half = std::abs(kappa) * longest > most ? most / std::abs(kappa) : longest;
  constexpr int n = 400;
  std::vector<std::pair<double, double>> points;
  for (int i = -n; i <= n; ++i) {
    const double s = half * i / n, sine = std::sin(kappa * s / 2);
    if (kappa == 0)
      points.emplace_back(s, -c);
    else
      points.emplace_back(std::sin(kappa * s) / kappa, -c - 2 * sine * sine / kappa);
  }
  return points;
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
  add({result.surface.front().angle + 2 * dealii::numbers::PI,
       result.surface.front().displacement});
  const auto name = [&scene](const std::string& field, Quantity quantity) {
    return field + scene.units.in_brackets(quantity);
  };
  return line_vtu(radius, {{name("angle", Quantity::angle), angle},
                           {name("displacement", Quantity::length), displacement},
                           {name("pressure", Quantity::pressure), pressure},
                           {name("gap", Quantity::length), gap}});
}

std::string road_vtu(const Scene& scene) {
  std::vector<double> radius, angles;
  for (const auto& [x, y] :
       points_of_road(scene, 2 * std::max(scene.outer_radius, scene.road_distance))) {
    radius.push_back(std::hypot(x, y) * scene.units.length);
    angles.push_back(1.5 * dealii::numbers::PI + std::atan2(x, -y));
  }
  return line_vtu(radius, {{"angle" + scene.units.in_brackets(Quantity::angle), angles}});
}

} // namespace rollwave
