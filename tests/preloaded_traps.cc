// Loaded into the program before its own libraries, this lets it compute as strictly as the tests.
#include "floating_point.h"

#include <cstdlib>

namespace {

__attribute__((constructor)) void trap() {
  unsetenv("LD_PRELOAD"); // gnuplot, which the program starts, computes as it likes
  rollwave::trap_floating_point();
}

} // namespace
