#include "quantities.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

namespace rollwave {

nlohmann::json quantities_of(const nlohmann::json& summary) {
  static const std::regex way("/(work|seconds|peak_memory_mib|iterations|remarks)\\b.*"
                              "|/cycles/.*/contact_steps");
  nlohmann::json quantities;
  const nlohmann::json all = summary.flatten();
  for (const auto& [path, value] : all.items())
    if (!std::regex_match(path, way))
      quantities[path] = value;
  return quantities;
}

void expect_same_quantities(const nlohmann::json& found, const nlohmann::json& expected,
                            const Tolerance& tolerance) {
  EXPECT_GT(expected.size(), 0u);
  for (const auto& [path, value] : expected.items())
    if (!found.contains(path))
      ADD_FAILURE() << path << " is missing";
    else if (value.is_number_float() && found[path].is_number_float()) {
      const double wanted = value;
      EXPECT_NEAR(found[path].get<double>(), wanted, tolerance(path, wanted)) << path;
    } else
      EXPECT_EQ(found[path], value) << path;
  for (const auto& [path, value] : found.items())
    EXPECT_TRUE(expected.contains(path)) << path << " is one too many";
}

double tolerance_of_solvers(const std::string& path, double expected) {
  const bool is_estimate = path.find("_uncertainty") != std::string::npos; // a small difference
  return path.find("/residuals/") == 0 ? 1e-10 : (is_estimate ? 1e-6 : 1e-9) * std::abs(expected);
}

double tolerance_of_uzawa(const std::string& path, double expected) {
  if (path.find("/residuals/") == 0)
    return 1e-6;
  // The gaps are part of the bound, the pressure is a derivative of the displacement, and both
  // place the ends.
  const std::regex rough(".*(certified|peak_pressure|bound|length|half_width|_end).*");
  const bool is_rough = std::regex_match(path, rough);
  const bool is_estimate = path.find("_uncertainty") != std::string::npos;
  return (is_estimate ? 1e-2 : is_rough ? 1e-4 : 1e-6) * std::abs(expected);
}

} // namespace rollwave
