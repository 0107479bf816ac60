#include "rollwave/base/run_statistics.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

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
      "mesh",          "space",       "assembly",
      "factorisation", "contact",     "back-substitution",
      "measurement",   "indicator",   "certificate",
      "output",        "verification"};
  return names;
}

RunStatistics::Phase::Phase(RunStatistics& statistics, const std::string& name)
    : statistics(statistics), name(checked(name)), outer(statistics.innermost) {
  statistics.innermost = this;
}

RunStatistics::Phase::~Phase() {
  const double all =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  statistics.seconds_of[name] += all - inner_seconds;
  if (statistics.observer)
    statistics.observer(name, all - inner_seconds);
  if (outer)
    outer->inner_seconds += all;
  statistics.innermost = outer;
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

double seconds_of_process() {
  std::string text, skipped;
  std::getline(std::ifstream("/proc/self/stat"), text);
  std::istringstream entries(text.substr(text.rfind(')') + 1)); // after the program's name
  for (int entry = 3; entry < 22; ++entry)
    entries >> skipped;
  double start = 0, now = 0; // after the start of the system
  if (!(entries >> start) || !(std::ifstream("/proc/uptime") >> now))
    return 0;
  return now - start / sysconf(_SC_CLK_TCK);
}

} // namespace rollwave
