#include "memory.h"

#include "control_group.h"
#include "errors.h"
#include "processes.h"

#include <deal.II/base/utilities.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace rollwave {

namespace {

constexpr double mebibyte = 1024. * 1024;

/// What libraries allocate besides, most of them without a way to tell that they could not.
constexpr double libraries_bytes = 64 * mebibyte;

} // namespace

double available_memory() {
  double available = memory_of_control_groups();
  std::ifstream meminfo("/proc/meminfo");
  std::string name, unit;
  double kibibytes = 0;
  while (meminfo >> name >> kibibytes && std::getline(meminfo, unit))
    if (name == "MemAvailable:")
      available = std::min(available, 1024 * kibibytes);
  return available;
}

std::optional<double> memory_below_limit() {
  double total, resident, shared, text, libraries, data;
  std::ifstream pages("/proc/self/statm");
  if (!(pages >> total >> resident >> shared >> text >> libraries >> data))
    return {};
  std::optional<double> room;
  const auto consider = [&room](auto resource, double used_pages) {
    rlimit limit;
    if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
      return;
    const double left = limit.rlim_cur - used_pages * sysconf(_SC_PAGESIZE);
    room = std::min(left, room.value_or(left));
  };
  consider(RLIMIT_AS, total);
  consider(RLIMIT_DATA, data);
  return room;
}

void reserve_blas_memory() {
  const auto room = memory_below_limit();
  if (!room)
    return;
  if (*room < blas_buffer_bytes + libraries_bytes) {
    std::ostringstream message;
    message << "the limit of memory (ulimit -v or -d) is too low by "
            << std::ceil((blas_buffer_bytes + libraries_bytes - *room) / mebibyte)
            << " MiB to begin; raise it";
    throw NotSolved(message.str());
  }
  // The first factorisation takes the buffer, which then stays.
  dealii::LAPACKFullMatrix<double> matrix(1);
  matrix(0, 0) = 1;
  matrix.set_property(dealii::LAPACKSupport::symmetric);
  matrix.compute_cholesky_factorization();
}

void require_memory(double bytes, const std::string& purpose, MPI_Comm communicator) {
  const double below_limit =
      memory_below_limit().value_or(std::numeric_limits<double>::infinity()) - libraries_bytes;
  const double on_machine = sum_on_machine(communicator, bytes), of_machine = available_memory();
  std::string lack;
  if (bytes > below_limit || on_machine > of_machine) {
    const bool is_limited = bytes > below_limit;
    std::ostringstream message;
    message.precision(3);
    message << purpose << " needs " << (is_limited ? bytes : on_machine) / mebibyte
            << " MiB of memory, and "
            << std::max(0., is_limited ? below_limit : of_machine) / mebibyte
            << " MiB are available";
    lack = message.str();
  }
  lack = first_text(communicator, lack);
  if (!lack.empty())
    throw NotEnoughMemory(lack);
}

void release_freed_memory() {
  malloc_trim(0);
}

double peak_memory_mib() {
  dealii::Utilities::System::MemoryStats memory;
  dealii::Utilities::System::get_memory_stats(memory);
  return memory.VmHWM / 1024.;
}

} // namespace rollwave
