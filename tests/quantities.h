#pragma once

#include <nlohmann/json.hpp>

#include <functional>
#include <string>

namespace rollwave {

/// The numbers of summary.json that describe a solution, by path, such as
/// /contact/patches/0/length: all except work, times, memory, iterations and remarks.
nlohmann::json quantities_of(const nlohmann::json& summary);

/// How far the number of a path may be from the expected one.
using Tolerance = std::function<double(const std::string& path, double expected)>;

/// Expects the same quantities in both, each number within its tolerance.
void expect_same_quantities(const nlohmann::json& found, const nlohmann::json& expected,
                            const Tolerance& tolerance);

/// For another linear solver or a sum in another order: 1e-9 of the number. Residuals are of the
/// size of round-off.
double tolerance_of_solvers(const std::string& path, double expected);

/// For Uzawa's method, which leaves gaps of 1e-8 of the displacement.
double tolerance_of_uzawa(const std::string& path, double expected);

} // namespace rollwave
