#include "result.h"

#include <algorithm>

namespace rollwave {

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

} // namespace rollwave
