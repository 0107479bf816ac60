#include "rollwave/base/memory.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <malloc.h>
#include <optional>
#include <sstream>
#include <string>

namespace rollwave {

namespace {

/// The number behind the first word @p name of a file's lines; nullopt where there is none.
std::optional<double> number_behind(const std::filesystem::path& file, const std::string& name) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string first;
    double number = 0;
    if (words >> first >> number && first == name)
      return number;
  }
  return {};
}

/// The number that a file holds; nullopt for a file that is not there, or the word "max".
std::optional<double> number_in(const std::filesystem::path& file) {
  double number = 0;
  return std::ifstream(file) >> number ? std::optional(number) : std::nullopt;
}

/// The files of the kernel that describe one version of control groups.
struct GroupFiles {
  const char *root, *limit, *usage;
  const char* reclaimable; ///< the word in memory.stat for cached files, which the kernel can drop
};

/// What the limits of the control group @p path and of those around it leave. Paths that are not
/// seen, as in a container whose own group is the root, are passed over.
double memory_of_groups(const std::filesystem::path& root, std::filesystem::path path,
                        const GroupFiles& files) {
  double least = std::numeric_limits<double>::infinity();
  for (bool is_root = false; !is_root; path = path.parent_path()) {
    is_root = !path.has_relative_path();
    const auto group = root / files.root / path.relative_path();
    const auto limit = number_in(group / files.limit), usage = number_in(group / files.usage);
    if (limit && usage)
      least =
          std::min(least, *limit - *usage +
                              number_behind(group / "memory.stat", files.reclaimable).value_or(0));
  }
  return std::max(least, 0.);
}

double sum_on_machine(MPI_Comm communicator, double value) {
  if (is_serial(communicator))
    return value;
  MPI_Comm machine;
  MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  const double sum = dealii::Utilities::MPI::sum(value, machine);
  MPI_Comm_free(&machine);
  return sum;
}

} // namespace

double available_memory(const std::filesystem::path& root) {
  constexpr GroupFiles version_1 = {"sys/fs/cgroup/memory", "memory.limit_in_bytes",
                                    "memory.usage_in_bytes", "total_inactive_file"},
                       version_2 = {"sys/fs/cgroup", "memory.max", "memory.current",
                                    "inactive_file"};
  double least = std::numeric_limits<double>::infinity();
  if (const auto kibibytes = number_behind(root / "proc/meminfo", "MemAvailable:"))
    least = 1024 * *kibibytes;
  // Lines "NUMBER:CONTROLLERS:PATH"; version 2 has the number 0 and no controllers.
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const auto colon = line.find(':'), second = line.find(':', colon + 1);
    if (second == std::string::npos)
      continue;
    const std::string controllers = line.substr(colon + 1, second - colon - 1),
                      path = line.substr(second + 1);
    if (controllers.empty())
      least = std::min(least, memory_of_groups(root, path, version_2));
    else if ((',' + controllers + ',').find(",memory,") != std::string::npos)
      least = std::min(least, memory_of_groups(root, path, version_1));
  }
  return least;
}

void require_memory(double bytes, const std::string& purpose, MPI_Comm communicator) {
  constexpr double mebibyte = 1024. * 1024;
  const double needed = sum_on_machine(communicator, bytes);
  if (!holds_on_all(communicator, needed <= available_memory())) {
    // SuperLU_DIST, a library that comes with deal.II, lets malloc keep all memory that is freed.
    malloc_trim(0);
    holds_on_all(communicator, true); // waits until all processes have given theirs back
  }
  const double available = available_memory();
  std::ostringstream lack;
  lack.precision(3);
  if (needed > available)
    lack << purpose << " needs " << needed / mebibyte << " MiB of memory, and "
         << available / mebibyte << " MiB are available";
  const std::string first_lack = first_text(communicator, lack.str());
  if (!first_lack.empty())
    throw NotEnoughMemory(first_lack);
}

double peak_memory_mib() {
  // deal.II's get_memory_stats() does not end where /proc is not there, as in a bare chroot.
  return number_behind("/proc/self/status", "VmHWM:").value_or(0) / 1024;
}

} // namespace rollwave
