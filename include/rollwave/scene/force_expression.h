#pragma once

#include <functional>
#include <optional>
#include <string>

namespace rollwave {

/// The function of r and z that @p expression stands for, by muParser.
/// @param any_radius at which it is tried
/// @throws BadValue where it cannot be parsed, would be misread (1,5), or is not finite
std::function<double(double r, double z)> parse_force(const std::string& expression,
                                                      double any_radius);

/// The value of @p expression if it has neither r nor z, such as 1/2 or pi; else nullopt.
/// @throws BadValue as parse_force()
std::optional<double> constant_force(const std::string& expression);

} // namespace rollwave
