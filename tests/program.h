#pragma once

#include "own_path.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/wait.h>

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
