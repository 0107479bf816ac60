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

/// True if the buffers of OpenBLAS for @p n threads fit, with the rest of a first call.
bool has_room_for_blas(long n) {
  constexpr std::size_t buffer = 128 << 20, rest = 32 << 20;
  const std::size_t size = buffer * n + rest;
  void* const room =
      mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED)
    return false;
  munmap(room, size);
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

/// The number of threads that OpenBLAS starts, at most one for each core.
__attribute__((no_sanitize("address", "undefined"))) long n_blas_threads() {
  const long cores = sysconf(_SC_NPROCESSORS_ONLN);
  for (const char* const variable : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"})
    if (const char* const value = std::getenv(variable))
      if (const long n = std::strtol(value, nullptr, 10); n > 0)
        return n < cores ? n : cores;
  return cores;
}

/// OpenBLAS takes 128 MiB of addresses for each thread in its constructor, and tries for ever if
/// there are none.
__attribute__((no_sanitize("address", "undefined"))) void check_room_for_blas() {
  if (is_address_space_limited() && !has_room_for_blas(n_blas_threads()))
    end_with("rollwave: not solved: not enough memory for the threads of OpenBLAS; set the "
             "environment variable OPENBLAS_NUM_THREADS=1, or raise the limit of the address space "
             "(ulimit -v)\n",
             2);
}

__attribute__((no_sanitize("address", "undefined"))) void prepare_environment(int, char**,
                                                                              char** environment) {
  environ = environment; // which the C library has not set yet
  check_number_of_threads();
  check_room_for_blas();
}

/// The loader calls the functions in this section before the constructors of libraries.
[[gnu::section(".preinit_array"),
  gnu::used]] void (*before_libraries)(int, char**, char**) = prepare_environment;

} // namespace

bool take_blas_buffer() {
  if (!is_address_space_limited())
    return true;
  if (!has_room_for_blas(1))
    return false;
  dealii::LAPACKFullMatrix<double> one(1), square(1);
  one.Tmmult(square, one);
  return true;
}

} // namespace rollwave
