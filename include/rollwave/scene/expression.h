#pragma once

#include <functional>
#include <optional>
#include <string>

namespace rollwave {

/// The value of a number, or of an expression of numbers as muParser reads it: 1/150 or
/// 4.5 / (2 * (1 + 0.49)).
/// @throws std::invalid_argument with the reason, also where the value is not finite, subnormal or
///         would be misread (1,5)
double evaluate(const std::string& expression);

/// The same; nullopt where evaluate() throws.
std::optional<double> value_if_any(const std::string& expression);

/// The function of r and z that @p expression stands for, as muParser reads it.
/// @param any_radius at which it is tried
/// @throws std::invalid_argument as evaluate()
std::function<double(double r, double z)> parse_function(const std::string& expression,
                                                         double any_radius);

} // namespace rollwave
