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
#include <string_view>
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

[[gnu::no_sanitize_address, gnu::no_sanitize_undefined]] bool is_address_space_limited() {
  rlimit limit;
  return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

/// True if a buffer of OpenBLAS fits, with the rest of a first call.
bool has_room_for_blas() {
  constexpr std::size_t buffer = 160 << 20;
  void* const room =
      mmap(nullptr, buffer, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED)
    return false;
  munmap(room, buffer);
  return true;
}

/// OpenBLAS takes 128 MiB of addresses for each thread in its constructor, and tries for ever if
/// there are none. Under a limit of the address space the program starts again with one thread,
/// unless the user has set a number, and ends where that does not fit.
[[gnu::no_sanitize_address, gnu::no_sanitize_undefined]] void
fit_blas_into_address_space(int, char** argv, char** environment) {
  if (!is_address_space_limited())
    return;
  environ = environment; // which the C library has not set yet
  const auto is_set = [](const char* variable) {
    const char* const value = std::getenv(variable);
    return value && *value;
  };
  if (!is_set("OPENBLAS_NUM_THREADS") && !is_set("OMP_NUM_THREADS")) {
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
    setenv("OMP_NUM_THREADS", "1", 1);
    execv("/proc/self/exe", argv); // since the C library forgets the new variables
  }
  if (has_room_for_blas())
    return;
  constexpr std::string_view message =
      "rollwave: not solved: not enough memory; raise the limit of the address space (ulimit -v)\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message.data(), message.size());
  _exit(2);
}

/// The loader calls the functions in this section before the constructors of libraries.
[[gnu::section(".preinit_array"),
  gnu::used]] void (*before_libraries)(int, char**, char**) = fit_blas_into_address_space;

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

bool take_blas_buffer() {
  if (!is_address_space_limited())
    return true;
  if (!has_room_for_blas())
    return false;
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
