#include "floating_point.h"

#include <cfenv>

namespace rollwave {

namespace {

constexpr int faults = FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW;

} // namespace

void trap_floating_point() {
  std::feclearexcept(faults);
  feenableexcept(faults);
}

UntrappedFloatingPoint::UntrappedFloatingPoint() : trapped(fegetexcept()) {
  fedisableexcept(faults);
}

UntrappedFloatingPoint::~UntrappedFloatingPoint() {
  // A flag that is still raised would trap at the next operation of the x87 unit.
  std::feclearexcept(faults);
  feenableexcept(trapped);
}

} // namespace rollwave
