#ifndef ROLLWAVE_BASE_CONTROL_GROUP_H
#define ROLLWAVE_BASE_CONTROL_GROUP_H

#include <filesystem>

namespace rollwave {

/**
 * The bytes that the control groups of this process leave, by which Linux limits the memory of
 * batch jobs and containers: the least of limit - use + files in memory that are not in use, over
 * the group and those it is in. Infinity without a limit, or where that is not known. Of both
 * versions of control groups.
 *
 * @param groups the file that names the groups @param root where they are mounted
 */
double memory_of_control_groups(const std::filesystem::path& groups = "/proc/self/cgroup",
                                const std::filesystem::path& root = "/sys/fs/cgroup");

} // namespace rollwave

#endif
