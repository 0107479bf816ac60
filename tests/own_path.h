#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace rollwave {

/// A temporary path of the running test's own, since tests run side by side.
inline std::filesystem::path own_path() {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string("rollwave_") + test.test_suite_name() + "_" + test.name();
  std::replace(name.begin(), name.end(), '/', '_');
  return std::filesystem::path(testing::TempDir()) / name;
}

} // namespace rollwave
