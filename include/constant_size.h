#ifndef ROLLWAVE_CONSTANT_SIZE_H
#define ROLLWAVE_CONSTANT_SIZE_H

#include <type_traits>

namespace rollwave {

/// f(n), where n is a number that the compiler knows if it is that of the nodes on a side of a
/// linear or quadratic element: innermost loops then take half of the time.
template <typename F>
auto with_constant_size(unsigned int n, const F& f) {
  switch (n) {
  case 2:
    return f(std::integral_constant<unsigned int, 2>());
  case 3:
    return f(std::integral_constant<unsigned int, 3>());
  default:
    return f(n);
  }
}

} // namespace rollwave

#endif
