#include "rollwave/base/run_statistics.h"

#include <algorithm>
#include <stdexcept>

namespace rollwave {

namespace {

const std::string& checked(const std::string& name) {
  const auto& names = RunStatistics::phase_names();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw std::out_of_range("there is no phase " + name);
  return name;
}

} // namespace

const std::vector<std::string>& RunStatistics::phase_names() {
  static const std::vector<std::string> names = {
      "mesh",          "space",          "assembly",    "ordering",
      "factorisation", "preconditioner", "contact",     "back-substitution",
      "measurement",   "indicator",      "certificate", "output"};
  return names;
}

RunStatistics::Phase::Phase(RunStatistics& work, const std::string& name)
    : work(work), name(checked(name)), outer(work.innermost) {
  work.innermost = this;
}

RunStatistics::Phase::~Phase() {
  const double all = timer.wall_time();
  work.seconds_of[name] += all - inner_seconds;
  if (work.observer)
    work.observer(name, all - inner_seconds);
  if (outer)
    outer->inner_seconds += all;
  work.innermost = outer;
}

std::optional<double> RunStatistics::seconds(const std::string& phase) const {
  const auto entry = seconds_of.find(phase);
  return entry == seconds_of.end() ? std::nullopt : std::optional(entry->second);
}

double RunStatistics::total_seconds() const {
  double total = 0;
  for (const auto& [phase, seconds] : seconds_of)
    total += seconds;
  return total;
}

} // namespace rollwave
