// What has to be done before the constructors of libraries.
#include "rollwave/base/start.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <cstdlib>
#include <string_view>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

namespace rollwave {

namespace {

// The sanitizers do not run yet.
[[noreturn]] __attribute__((no_sanitize("address", "undefined"))) void
end_with(std::string_view message, int exit_code) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message.data(), message.size());
  _exit(exit_code);
}

__attribute__((no_sanitize("address", "undefined"))) bool is_address_space_limited() {
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

/// deal.II aborts in a constructor where this variable is no number of threads.
__attribute__((no_sanitize("address", "undefined"))) void check_number_of_threads() {
  const char* const value = std::getenv("DEAL_II_NUM_THREADS");
  if (!value)
    return;
  char* end = nullptr;
  const long number = std::strtol(value, &end, 10);
  if (end == value || *end != '\0' || number < 1)
    end_with("rollwave: the environment variable DEAL_II_NUM_THREADS must be a whole number from 1 "
             "on, or not be set\n",
             1);
}

/// OpenBLAS takes 128 MiB of addresses for each thread in its constructor, and tries for ever if
/// there are none. Under a limit of the address space the program starts again with one thread,
/// unless the user has set a number, and ends where that does not fit.
__attribute__((no_sanitize("address", "undefined"))) void
fit_blas_into_address_space(char** arguments) {
  if (!is_address_space_limited())
    return;
  const auto is_set = [](const char* variable) {
    const char* const value = std::getenv(variable);
    return value && *value;
  };
  if (!is_set("OPENBLAS_NUM_THREADS") && !is_set("OMP_NUM_THREADS")) {
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
    setenv("OMP_NUM_THREADS", "1", 1);
    execv("/proc/self/exe", arguments); // since the C library forgets the new variables
  }
  if (!has_room_for_blas())
    end_with("rollwave: not solved: not enough memory; raise the limit of the address space "
             "(ulimit -v)\n",
             2);
}

__attribute__((no_sanitize("address", "undefined"))) void prepare_environment(int, char** arguments,
                                                                              char** environment) {
  environ = environment; // which the C library has not set yet
  check_number_of_threads();
  fit_blas_into_address_space(arguments);
}

/// The loader calls the functions in this section before the constructors of libraries.
[[gnu::section(".preinit_array"),
  gnu::used]] void (*before_libraries)(int, char**, char**) = prepare_environment;

} // namespace

bool take_blas_buffer() {
  if (!is_address_space_limited())
    return true;
  if (!has_room_for_blas())
    return false;
  dealii::LAPACKFullMatrix<double> one(1), square(1);
  one.Tmmult(square, one);
  return true;
}

} // namespace rollwave
