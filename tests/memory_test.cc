// The memory that there is, from files as the kernel writes them.
#include "rollwave/base/errors.h"
#include "rollwave/base/memory.h"
#include "rollwave/base/run_statistics.h"
#include "rollwave/run/mesh.h"
#include "test_scenes.h"

#include "own_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace fs = std::filesystem;
using namespace rollwave;

namespace {

class Memory : public testing::Test {
protected:
  Memory() : root(own_path()) {
    fs::remove_all(root);
    write("proc/meminfo", "MemTotal:  4000 kB\nMemFree:  100 kB\nMemAvailable:   3000 kB\n");
  }
  ~Memory() override { fs::remove_all(root); }

  void write(const fs::path& file, const std::string& text) const {
    fs::create_directories((root / file).parent_path());
    std::ofstream(root / file) << text;
  }

  /// The words of one version of control groups: the names of its files of limit and usage, its
  /// text for "no limit", and the beginning of memory.stat up to the memory of cached files.
  struct Words {
    std::string limit, unlimited, usage, statistics;
  };

  /// Two groups, one within the other: the outer one has a limit, the inner one has none.
  void expect_limit_of_outer_group(const fs::path& outer, const std::string& inner,
                                   const Words& words) const {
    write(outer / inner / words.limit, words.unlimited + '\n');
    write(outer / inner / words.usage, "200000\n");
    EXPECT_EQ(available_memory(root), 3000 * 1024);
    write(outer / words.limit, "1000000\n");
    write(outer / words.usage, "300000\n");
    EXPECT_EQ(available_memory(root), 700000);
    write(outer / "memory.stat", words.statistics + " 50000\n");
    EXPECT_EQ(available_memory(root), 750000);
    write(outer / words.usage, "1200000\n");
    EXPECT_EQ(available_memory(root), 0);
  }

  const fs::path root;
};

TEST_F(Memory, IsWhatTheMachineHasWithoutGroups) {
  EXPECT_EQ(available_memory(root), 3000 * 1024);
  EXPECT_EQ(available_memory(root / "elsewhere"), INFINITY);
  EXPECT_GT(available_memory(), 0);
}

TEST_F(Memory, IsLimitedByGroupsOfVersion1) {
  write("proc/self/cgroup", "5:cpu:/a/b\n4:hugetlb,memory:/slurm/job/step\n0::/\n");
  expect_limit_of_outer_group("sys/fs/cgroup/memory/slurm/job", "step",
                              {"memory.limit_in_bytes", "9223372036854771712",
                               "memory.usage_in_bytes", "inactive_file 1\ntotal_inactive_file"});
}

TEST_F(Memory, IsLimitedByGroupsOfVersion2) {
  write("proc/self/cgroup", "0::/user.slice/run.scope\n");
  expect_limit_of_outer_group("sys/fs/cgroup/user.slice", "run.scope",
                              {"memory.max", "max", "memory.current", "anon 7\ninactive_file"});
}

// Its own group is the root that it sees, whatever the path is that the host gives it.
TEST_F(Memory, IsLimitedByTheGroupOfAContainer) {
  write("proc/self/cgroup", "0::/docker/0123\n");
  write("sys/fs/cgroup/memory.max", "1000000\n");
  write("sys/fs/cgroup/memory.current", "400000\n");
  EXPECT_EQ(available_memory(root), 600000);
}

TEST_F(Memory, IsAskedForBeforeAMeshIsMade) {
  const Parameters parameters =
      parameters_of({"Mesh/Degree=1", "Mesh/Radial cells=40000", "Mesh/Angular cells=50000",
                     "Mesh/Most unknowns=2147483647"});
  RunStatistics statistics;
  EXPECT_THROW(make_mesh(make_scene(parameters), parameters, MPI_COMM_SELF, statistics),
               NotEnoughMemory);
  EXPECT_LT(peak_memory_mib(), 10000);
}

} // namespace
