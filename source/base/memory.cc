#include "rollwave/base/memory.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

namespace rollwave {

namespace {

/// MemAvailable of Linux in bytes, infinity where that is not known.
double available_memory() {
  std::ifstream lines("/proc/meminfo");
  std::string name, unit;
  for (double kibibytes = 0; lines >> name >> kibibytes && std::getline(lines, unit);)
    if (name == "MemAvailable:")
      return 1024 * kibibytes;
  return std::numeric_limits<double>::infinity();
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
  const auto is_set = [](const char* variable) {
    const char* const value = std::getenv(variable);
    return value && *value;
  };
  if (!is_set("OPENBLAS_NUM_THREADS") && !is_set("OMP_NUM_THREADS")) {
    // OpenBLAS has read its variables before main() begins.
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
    setenv("OMP_NUM_THREADS", "1", 1);
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
