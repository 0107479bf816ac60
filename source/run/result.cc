#include "rollwave/run/result.h"

#include "rollwave/scene/units.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace rollwave {

double Residuals::largest() const {
  return std::max({equilibrium, penetration, negative_pressure, complementarity});
}

double pressure_at(const std::vector<ContactRow>& rows, double z) {
  const auto next =
      std::lower_bound(rows.begin(), rows.end(), z,
                       [](const ContactRow& row, double angle) { return row.angle < angle; });
  if (next == rows.end() || (next == rows.begin() && next->angle > z))
    return 0;
  if (next->angle == z)
    return next->pressure;
  const ContactRow& before = *(next - 1);
  const double t = (z - before.angle) / (next->angle - before.angle);
  return (1 - t) * before.pressure + t * next->pressure;
}

std::string shortfall_text(const Result& result) {
  std::string text;
  for (const std::string& shortfall : result.shortfalls)
    text += (text.empty() ? "" : "; ") + shortfall;
  return text;
}

Result in_users_units(Result result, const Units& units) {
  const auto convert = [](double factor, std::initializer_list<double*> numbers) {
    for (double* const number : numbers)
      *number *= factor;
  };
  const double length = units.length, pressure = units.of(Quantity::pressure),
               force = units.of(Quantity::force), energy = units.of(Quantity::energy),
               energy_norm = units.of(Quantity::energy_norm);
  auto& patch = result.patch;
  convert(length, {&result.mesh.h_min, &result.mesh.h_max, &result.road_distance});
  convert(force, {&patch.force, &patch.vertical_load, &patch.work_conjugate_load});
  convert(pressure, {&patch.peak_pressure});
  convert(units.of(Quantity::stiffness),
          {&patch.stiffness.total, &patch.stiffness.vertical, &patch.stiffness.work_conjugate});
  for (ContactPatch& part : patch.patches) {
    convert(force, {&part.force});
    convert(length, {&part.length});
    convert(pressure, {&part.peak_pressure});
  }
  convert(energy, {&result.energy.value, &result.energy.norm_squared});
  if (auto& certified = result.certified) {
    convert(energy_norm, {&certified->energy_norm, &certified->force_data});
    convert(energy, {&certified->lower_bound, &certified->upper_bound, &certified->norm_squared});
    convert(length, {&certified->sampled_width});
  }
  if (auto& bounds = result.load_bounds)
    convert(force, {&bounds->lower, &bounds->upper});
  if (auto& bounds = result.distance_bounds)
    convert(length, {&bounds->lower, &bounds->upper});
  if (auto& errors = result.errors) {
    convert(energy_norm, {&errors->energy_norm});
    convert(units.of(Quantity::area), {&errors->l2_norm});
    convert(units.of(Quantity::pressure_norm), {&errors->pressure});
    convert(force, {&errors->force});
    convert(energy, {&errors->energy});
    if (auto& distance = errors->exact_distance)
      convert(length, {&*distance});
    if (auto& norm = errors->admissible_energy_norm)
      convert(energy_norm, {&*norm});
  }
  for (CycleFigures& cycle : result.cycles)
    convert(energy_norm, {&cycle.indicated});
  for (ContactStep& step : result.history) {
    convert(length, {&step.penetration});
    convert(pressure, {&step.lowest_pressure});
  }
  convert(units.of(Quantity::force_density), {&result.rho});
  for (ContactRow& row : result.contact_rows) {
    convert(length, {&row.displacement, &row.road, &row.gap});
    convert(pressure, {&row.pressure});
    convert(length * units.material.width, {&row.weight});
  }
  for (SurfacePoint& point : result.surface)
    convert(length, {&point.displacement});
  return result;
}

} // namespace rollwave
