// All tests compute without a division by zero, an invalid operation or an overflow; where one is
// meant, the test says so by UntrappedFloatingPoint.
#include "floating_point.h"

#include <gtest/gtest.h>

int main(int argc, char* argv[]) {
  testing::InitGoogleTest(&argc, argv);
  rollwave::trap_floating_point();
  return RUN_ALL_TESTS();
}
