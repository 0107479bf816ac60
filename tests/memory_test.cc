// What control groups leave of the memory, read from directories like those of the system.
#include "own_path.h"
#include "rollwave/base/memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

using namespace rollwave;

namespace {

class ControlGroups : public testing::Test {
protected:
  ControlGroups() { std::filesystem::remove_all(root); }
  ~ControlGroups() override { std::filesystem::remove_all(root); }

  void write(const std::string& file, const std::string& content) const {
    std::filesystem::create_directories((root / file).parent_path());
    std::ofstream(root / file) << content;
  }

  double memory() const { return memory_of_control_groups(root / "groups", root); }

  const std::filesystem::path root = own_path();
};

TEST_F(ControlGroups, LeaveTheLeastOfAllLevels) {
  write("groups", "0::/job/step\n");
  write("job/step/memory.max", "max\n");
  write("job/step/memory.current", "700\n");
  EXPECT_TRUE(std::isinf(memory()));
  write("job/memory.max", "1000\n");
  write("job/memory.current", "800\n");
  EXPECT_EQ(memory(), 200);
  write("job/memory.stat", "anon 5\ninactive_file 300\nactive_file 7\n");
  EXPECT_EQ(memory(), 500);
  write("job/step/memory.max", "710\n");
  EXPECT_EQ(memory(), 10);
  write("job/step/memory.current", "720\n");
  EXPECT_EQ(memory(), 0);
}

TEST_F(ControlGroups, AreReadInTheFirstVersionToo) {
  write("groups", "5:cpu,cpuacct:/batch\n4:memory:/batch:1\n0::/\n");
  write("memory/batch:1/memory.limit_in_bytes", "5000\n");
  write("memory/batch:1/memory.usage_in_bytes", "1000\n");
  write("memory/batch:1/memory.stat", "inactive_file 1\ntotal_inactive_file 20\n");
  EXPECT_EQ(memory(), 4020);
  write("memory/memory.limit_in_bytes", "9223372036854771712\n");
  write("memory/memory.usage_in_bytes", "3000\n");
  EXPECT_EQ(memory(), 4020);
}

TEST_F(ControlGroups, ThatAreNotThereLimitNothing) {
  EXPECT_TRUE(std::isinf(memory()));
  write("groups", "4:memory:/gone\n0::/gone\n");
  EXPECT_TRUE(std::isinf(memory()));
  write("groups", "no such line");
  EXPECT_TRUE(std::isinf(memory()));
}

} // namespace
