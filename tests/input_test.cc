// Any bytes, taken as a parameter file or as a command line, are accepted or refused in one message
// that a terminal can show; an accepted text is a scene, and is read back from its printed form.
#include "draw.h"
#include "rollwave/base/errors.h"
#include "rollwave/parameters/command_line.h"
#include "rollwave/parameters/parameters.h"
#include "rollwave/scene/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace rollwave;

namespace {

std::string printed(const std::vector<Setting>& settings) {
  std::ostringstream text;
  print_parameters(text, read_parameters(settings));
  return text.str();
}

/// The settings of a parameter file or, in a text that begins with '-', of a command line with one
/// argument in each line.
std::vector<Setting> settings_in(const std::string& text) {
  if (text.empty() || text.front() != '-')
    return parse_settings(text, "input");
  std::vector<std::string> arguments;
  std::istringstream lines(text);
  for (std::string argument; std::getline(lines, argument);)
    arguments.push_back(argument);
  return read_command_line(arguments).settings;
}

void expect_accepted_or_refused(const std::string& text) {
  try {
    const std::vector<Setting> settings = settings_in(text);
    const Scene scene = make_scene(read_parameters(settings));
    EXPECT_LT(0, scene.inner_radius);
    EXPECT_LT(scene.inner_radius, scene.outer_radius);
    EXPECT_LT(scene.zone_begin, scene.zone_end);
    EXPECT_TRUE(std::isfinite(scene.phi((scene.zone_begin + scene.zone_end) / 2)));
    EXPECT_FALSE(std::isnan(scene.force.uniform.value_or(0)));
    const std::string complete = printed(settings);
    EXPECT_EQ(printed(parse_settings(complete, "input")), complete);
  } catch (const BadInput& refusal) {
    const std::string message = refusal.what();
    EXPECT_FALSE(message.empty());
    EXPECT_LT(message.size(), 8192u);
    EXPECT_TRUE(std::none_of(message.begin(), message.end(), [](unsigned char c) {
      return std::iscntrl(c) && c != '\n';
    })) << message;
  }
}

/// Files that were refused or misread once, and those that are shipped.
std::vector<std::string> known_texts() {
  std::vector<std::string> texts = {printed({})};
  for (const char* directory : {ROLLWAVE_SOURCE_DIRECTORY "/tests/corpus", ROLLWAVE_PRM_DIRECTORY})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(directory))
      if (entry.is_regular_file()) {
        std::ifstream file(entry.path());
        texts.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
      }
  return texts;
}

/// Cuts a piece out of a text, doubles it, or replaces it by a word with a meaning or by any byte.
void damage(std::string& text, Draw& draw) {
  static const std::vector<std::string> words = {
      "subsection ", "set ",       "end\n", " = ",   "\\\n",   "#",        "auto",
      "--set\n",     "nan",        "-inf",  "1e308", "1e-308", "4.9e-324", "0x10",
      "2147483648",  "4294967295", "-1",    "sin(",  "if(",    "^",        "rand()",
      " | ",         "; ",         "{",     "\"",    "&"};
  const int begin = draw.count(0, text.size()), length = draw.count(0, 12);
  const std::string piece = text.substr(begin, length);
  switch (draw.count(0, 3)) {
  case 0:
    text.erase(begin, length);
    break;
  case 1:
    text.insert(begin, piece);
    break;
  case 2:
    text.replace(begin, length, draw.one_of(words));
    break;
  default:
    text.insert(begin, 1, static_cast<char>(draw.count(0, 255)));
  }
}

TEST(Input, KnownTextsAreAcceptedOrRefused) {
  for (const std::string& text : known_texts()) {
    SCOPED_TRACE(text);
    expect_accepted_or_refused(text);
  }
}

TEST(Input, DamagedTextsAreAcceptedOrRefused) {
  const std::vector<std::string> texts = known_texts();
  Draw draw(20);
  for (int i = 0; i < n_random_scenes(2000); ++i) {
    std::string text = draw.one_of(texts);
    for (int times = draw.count(1, 4); times > 0; --times)
      damage(text, draw);
    SCOPED_TRACE(text);
    expect_accepted_or_refused(text);
  }
}

} // namespace
