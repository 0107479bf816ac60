#ifndef ROLLWAVE_TESTS_FLOATING_POINT_H
#define ROLLWAVE_TESTS_FLOATING_POINT_H

namespace rollwave {

/// From here on a division by zero, an invalid operation or an overflow ends the process by SIGFPE.
void trap_floating_point();

/// No such end while it lives, for what is meant to compute infinities or NaN.
class UntrappedFloatingPoint {
public:
  UntrappedFloatingPoint();
  ~UntrappedFloatingPoint();
  UntrappedFloatingPoint(const UntrappedFloatingPoint&) = delete;
  UntrappedFloatingPoint& operator=(const UntrappedFloatingPoint&) = delete;

private:
  int trapped;
};

} // namespace rollwave

#endif
