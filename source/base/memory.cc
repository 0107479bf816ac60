#include "rollwave/base/memory.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

namespace rollwave {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The number of @p name in a file of lines "NAME NUMBER ...", -1 without that line.
double number_in(const std::filesystem::path& file, const std::string& name) {
  std::ifstream lines(file);
  std::string word, rest;
  for (double number = 0; lines >> word >> number && std::getline(lines, rest);)
    if (word == name)
      return number;
  return -1;
}

/// What one group leaves of its own limit.
double memory_of_group(const std::filesystem::path& group, bool is_first_version) {
  double limit = 0, use = 0;
  // Without a limit the second version says "max".
  if (!(std::ifstream(group / (is_first_version ? "memory.limit_in_bytes" : "memory.max")) >>
        limit) ||
      !(std::ifstream(group / (is_first_version ? "memory.usage_in_bytes" : "memory.current")) >>
        use))
    return unlimited;
  const double idle_files =
      number_in(group / "memory.stat", is_first_version ? "total_inactive_file" : "inactive_file");
  return std::max(0., limit - use + std::max(0., idle_files));
}

double available_memory() {
  const double available = 1024 * number_in("/proc/meminfo", "MemAvailable:");
  return std::min(available < 0 ? unlimited : available,
                  memory_of_control_groups("/proc/self/cgroup", "/sys/fs/cgroup"));
}

double sum_on_machine(MPI_Comm communicator, double value) {
  if (is_alone(communicator))
    return value;
  MPI_Comm machine;
  MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  const double sum = dealii::Utilities::MPI::sum(value, machine);
  MPI_Comm_free(&machine);
  return sum;
}

} // namespace

double memory_of_control_groups(const std::filesystem::path& groups,
                                const std::filesystem::path& root) {
  double least = unlimited;
  std::ifstream lines(groups);
  for (std::string number, controllers, path; std::getline(lines, number, ':') &&
                                              std::getline(lines, controllers, ':') &&
                                              std::getline(lines, path);) {
    // The second version names no controllers.
    const bool is_first_version = !controllers.empty();
    if (is_first_version && ("," + controllers + ",").find(",memory,") == std::string::npos)
      continue;
    const std::filesystem::path mount = is_first_version ? root / "memory" : root;
    std::filesystem::path group = std::filesystem::path(path).relative_path();
    for (; !group.empty(); group = group.parent_path())
      least = std::min(least, memory_of_group(mount / group, is_first_version));
    least = std::min(least, memory_of_group(mount, is_first_version));
  }
  return least;
}

void require_memory(double bytes, const std::string& purpose, MPI_Comm communicator) {
  constexpr double mebibyte = 1024. * 1024;
  const double needed = sum_on_machine(communicator, bytes), available = available_memory();
  std::ostringstream lack;
  lack.precision(3);
  if (needed > available)
    lack << purpose << " needs " << needed / mebibyte << " MiB of memory, and "
         << available / mebibyte << " MiB are available";
  const std::string first_lack = first_text(communicator, lack.str());
  if (!first_lack.empty())
    throw NotEnoughMemory(first_lack);
}

bool fit_blas_into_address_space(char** argv) {
  rlimit limit;
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return true;
  if (!std::getenv("OPENBLAS_NUM_THREADS") && !std::getenv("OMP_NUM_THREADS")) {
    // OpenBLAS has read its variables before main() begins.
    setenv("OPENBLAS_NUM_THREADS", "1", 0);
    execv("/proc/self/exe", argv); // which returns only if it fails
  }
  constexpr std::size_t buffer = 160 << 20; // with the rest of a first call
  void* const room =
      mmap(nullptr, buffer, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED)
    return false;
  munmap(room, buffer);
  dealii::LAPACKFullMatrix<double> one(1), square(1);
  one.Tmmult(square, one);
  return true;
}

double peak_memory_mib() {
  dealii::Utilities::System::MemoryStats memory;
  dealii::Utilities::System::get_memory_stats(memory);
  return memory.VmHWM / 1024.;
}

} // namespace rollwave
