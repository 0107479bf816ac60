#pragma once

#include "own_path.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <vector>

struct Outcome {
  int exit_code;
  std::string text; ///< both streams
};

/// The exit code as a shell reports it, from what wait() and pclose() return.
inline int exit_code_of(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Runs @p command in a shell, where $rollwave is the program.
inline Outcome shell(const std::string& command) {
  setenv("rollwave", ROLLWAVE_EXECUTABLE, 1);
  FILE* const pipe = popen(("( " + command + " ) 2>&1").c_str(), "r");
  Outcome outcome;
  std::array<char, 4096> buffer;
  std::size_t count = 0;
  while ((count = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0)
    outcome.text.append(buffer.data(), count);
  outcome.exit_code = exit_code_of(pclose(pipe));
  return outcome;
}

/// A row of a CSV file by the names of its columns.
using CsvRow = std::map<std::string, std::string>;

/// The rows of a CSV file; texts with commas are in quotation marks.
inline std::vector<CsvRow> csv_rows(const std::string& text) {
  static const std::regex field("(\"[^\"]*\"|[^,]*)(,|$)");
  std::vector<std::string> names;
  std::vector<CsvRow> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> fields;
    for (std::sregex_iterator match(line.begin(), line.end(), field), end; match != end; ++match)
      fields.push_back((*match)[1]);
    if (names.empty())
      names = fields;
    else {
      rows.emplace_back();
      for (std::size_t k = 0; k < names.size() && k < fields.size(); ++k)
        rows.back()[names[k]] = fields[k];
    }
  }
  return rows;
}

/// The program on a small scene, with a directory of its own for each test, empty at first.
class Program : public testing::Test {
protected:
  Program() : directory(rollwave::own_path()) {
    std::filesystem::remove_all(directory);
    std::filesystem::create_directories(directory);
    std::ofstream(directory / "scene.prm")
        << "subsection Mesh\n  set Radial cells = 4\n  set Angular cells = 60\nend\n"
           "subsection Output\n  set Directory = "
        << (directory / "out").string() << "\nend\n";
    scene = "'" + (directory / "scene.prm").string() + "'";
  }

  ~Program() override { std::filesystem::remove_all(directory); }

  std::string read(const std::string& name) const {
    std::ifstream file(directory / "out" / name);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

  bool has(const std::string& name) const {
    return std::filesystem::exists(directory / "out" / name);
  }

  void expect_no_partial_files() const {
    if (!std::filesystem::exists(directory / "out"))
      return;
    for (const auto& entry : std::filesystem::directory_iterator(directory / "out"))
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }

  const std::filesystem::path directory;
  std::string scene; ///< its parameter file, quoted for the shell
};
