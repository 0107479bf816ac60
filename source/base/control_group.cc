#include "rollwave/base/control_group.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace rollwave {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Where a version of control groups keeps its numbers.
struct Names {
  std::filesystem::path mount;
  const char* limit;
  const char* use;
  const char* idle_files;
};

/// What one group leaves of its own limit.
double memory_of_group(const std::filesystem::path& group, const Names& names) {
  double limit = 0, use = 0, idle_files = 0;
  // Without a limit the newer version says "max".
  if (!(std::ifstream(group / names.limit) >> limit) || !(std::ifstream(group / names.use) >> use))
    return unlimited;
  std::ifstream statistics(group / "memory.stat");
  std::string name;
  for (double bytes = 0; statistics >> name >> bytes;)
    if (name == names.idle_files)
      idle_files = bytes;
  return std::max(0., limit - use + idle_files);
}

} // namespace

double memory_of_control_groups(const std::filesystem::path& groups,
                                const std::filesystem::path& root) {
  const Names first = {root / "memory", "memory.limit_in_bytes", "memory.usage_in_bytes",
                       "total_inactive_file"},
              second = {root, "memory.max", "memory.current", "inactive_file"};
  double least = unlimited;
  std::ifstream lines(groups);
  for (std::string number, controllers, path; std::getline(lines, number, ':') &&
                                              std::getline(lines, controllers, ':') &&
                                              std::getline(lines, path);) {
    if (!controllers.empty() && ("," + controllers + ",").find(",memory,") == std::string::npos)
      continue;
    const Names& names = controllers.empty() ? second : first;
    std::filesystem::path group = std::filesystem::path(path).relative_path();
    for (;; group = group.parent_path()) {
      least = std::min(least, memory_of_group(names.mount / group, names));
      if (group.empty())
        break;
    }
  }
  return least;
}

} // namespace rollwave
