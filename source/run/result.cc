#include "rollwave/run/result.h"

#include <algorithm>

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

} // namespace rollwave
