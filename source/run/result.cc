#include "rollwave/run/result.h"

#include <algorithm>

namespace rollwave {

double Residuals::largest() const {
  return std::max({equilibrium, penetration, negative_pressure, complementarity});
}

} // namespace rollwave
