#include "rollwave/base/work.h"

#include <algorithm>

namespace rollwave {

Work::Phase::Phase(Work& work, const std::string& name)
    : work(work), name(name), outer(work.innermost) {
  work.innermost = this;
}

Work::Phase::~Phase() {
  const double seconds = timer.wall_time();
  work.add_seconds(name, seconds - inner_seconds);
  if (outer)
    outer->inner_seconds += seconds;
  work.innermost = outer;
}

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
