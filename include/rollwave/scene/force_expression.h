#pragma once

#include <functional>
#include <optional>
#include <string>

namespace rollwave {

/// The function of r and z that @p expression stands for, by muParser.
/// @param any_radius at which it is tried
/// @throws BadValue where it cannot be parsed, means something else than it says, or is not finite
std::function<double(double r, double z)> parse_force(const std::string& expression,
                                                      double any_radius);

/// The force where @p expression is a number or depends on neither r nor z, as 1/2 and pi.
/// @throws BadValue as parse_force()
std::optional<double> constant_force(const std::string& expression);

} // namespace rollwave
