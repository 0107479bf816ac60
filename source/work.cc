#include "work.h"

#include <algorithm>

namespace rollwave {

void Work::add_seconds(const std::string& phase, double seconds) {
  const auto entry = std::find_if(phases.begin(), phases.end(),
                                  [&phase](const auto& known) { return known.first == phase; });
  if (entry == phases.end())
    phases.emplace_back(phase, seconds);
  else
    entry->second += seconds;
}

double Work::total_seconds() const {
  double total = 0;
  for (const auto& [phase, seconds] : phases)
    total += seconds;
  return total;
}

} // namespace rollwave
