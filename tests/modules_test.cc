// Each module includes only those below it, and no file grows beyond 300 lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> modules = {"base",       "scene",       "exact",  "mesh", "solver",
                                          "contact",    "error_bound", "adapt",  "run",  "verify",
                                          "parameters", "plot",        "output", "study"};

/// The number of a module, from the lowest; files in no module are above all modules.
std::size_t height(const std::string& module) {
  return std::find(modules.begin(), modules.end(), module) - modules.begin();
}

std::string module_of(const fs::path& file, const fs::path& root) {
  const fs::path relative = fs::relative(file, root);
  return relative.has_parent_path() ? relative.begin()->string() : "";
}

TEST(Modules, IncludeLowerModulesOnlyAndFilesAreShort) {
  const std::regex include("#include \"rollwave/(?:(\\w+)/)?\\w+\\.h\"");
  unsigned int n_includes = 0;
  for (const fs::path root :
       {ROLLWAVE_SOURCE_DIRECTORY "/include/rollwave", ROLLWAVE_SOURCE_DIRECTORY "/source"})
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      if (!entry.is_regular_file())
        continue;
      const std::size_t own = height(module_of(entry.path(), root));
      std::ifstream lines(entry.path());
      std::string line;
      unsigned int n_lines = 0;
      for (std::smatch match; std::getline(lines, line); ++n_lines)
        if (std::regex_match(line, match, include)) {
          EXPECT_LE(height(match[1]), own) << entry.path() << ": " << line;
          ++n_includes;
        }
      EXPECT_LE(n_lines, 300u) << entry.path();
    }
  EXPECT_GT(n_includes, 200u);
}

} // namespace
