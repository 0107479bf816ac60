// Loaded into the program before its own libraries, this lets it compute as strictly as the tests.
#include "floating_point.h"

#include <cstdlib>

namespace {

__attribute__((constructor)) void trap() {
  unsetenv("LD_PRELOAD"); // gnuplot, which the program starts, computes as it likes
  rollwave::trap_floating_point();
}

} // namespace

extern "C" int PMPI_Init_thread(int* argc, char*** argv, int required, int* provided);

/// In place of MPI's own, which looks for the machine's processors with libxml2: that makes NaNs.
extern "C" int MPI_Init_thread(int* argc, char*** argv, int required, int* provided) {
  const rollwave::UntrappedFloatingPoint in_libraries;
  return PMPI_Init_thread(argc, argv, required, provided);
}
