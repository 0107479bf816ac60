#include "rollwave/run/result.h"

#include <algorithm>

namespace rollwave {

double Residuals::largest() const {
  return std::max({equilibrium, penetration, negative_pressure, complementarity});
}

std::string shortfall_text(const Result& result) {
  std::string text;
  for (const std::string& shortfall : result.shortfalls)
    text += (text.empty() ? "" : "; ") + shortfall;
  return text;
}

} // namespace rollwave
