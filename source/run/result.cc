#include "rollwave/run/result.h"

#include <algorithm>
#include <cmath>

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

Result to_lengths(Result result, double unit) {
  const double square = unit * unit;
  for (double* const length :
       {&result.mesh.h_min, &result.mesh.h_max, &result.road_distance, &result.patch.force,
        &result.patch.vertical_load, &result.patch.work_conjugate_load})
    *length *= unit;
  result.energy.value *= square;
  result.energy.norm_squared *= square;
  if (auto& certified = result.certified) {
    certified->energy_norm *= unit;
    certified->force_data *= unit;
    certified->lower_bound *= square;
    certified->upper_bound *= square;
    certified->norm_squared *= square;
    certified->sampled_width *= unit;
  }
  for (ContactPatch& patch : result.patch.patches) {
    patch.force *= unit;
    patch.length *= unit;
  }
  for (auto* const bounds : {&result.load_bounds, &result.distance_bounds})
    if (*bounds) {
      (*bounds)->lower *= unit;
      (*bounds)->upper *= unit;
    }
  if (auto& errors = result.errors) {
    errors->energy_norm *= unit;
    errors->l2_norm *= square;
    errors->pressure *= std::sqrt(unit);
    errors->force *= unit;
    errors->energy *= square;
    if (errors->exact_distance)
      *errors->exact_distance *= unit;
    if (errors->admissible_energy_norm)
      *errors->admissible_energy_norm *= unit;
  }
  for (CycleFigures& cycle : result.cycles)
    cycle.indicated *= unit;
  for (ContactStep& step : result.history)
    step.penetration *= unit;
  result.rho /= unit;
  for (ContactRow& row : result.contact_rows)
    for (double* const length : {&row.displacement, &row.road, &row.gap, &row.weight})
      *length *= unit;
  for (SurfacePoint& point : result.surface)
    point.displacement *= unit;
  return result;
}

} // namespace rollwave
