// Any bytes, taken as a parameter file or as a command line, are accepted or refused in one message
// that a terminal can show; what is accepted is a scene, and is read back from what is printed.
#include "rollwave/base/errors.h"
#include "rollwave/parameters/command_line.h"
#include "rollwave/parameters/parameters.h"
#include "rollwave/scene/scene.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <sstream>

using namespace rollwave;

namespace {

void require(bool holds, const char* what, const std::string& detail = {}) {
  if (holds)
    return;
  std::fprintf(stderr, "Broken promise: %s\n%s\n", what, detail.c_str());
  std::abort();
}

std::string printed(const std::vector<Setting>& settings) {
  std::ostringstream text;
  print_parameters(text, settings);
  return text.str();
}

/// One argument in each line, the way that many command lines fit into a file each.
std::vector<Setting> settings_of_command_line(const std::string& text) {
  std::vector<std::string> arguments;
  std::istringstream lines(text);
  for (std::string argument; std::getline(lines, argument);)
    arguments.push_back(argument);
  return read_command_line(arguments).settings;
}

void read(const std::string& text) {
  const std::vector<Setting> settings = !text.empty() && text.front() == '-'
                                            ? settings_of_command_line(text)
                                            : parse_settings(text, "input");
  const Parameters parameters = read_parameters(settings);
  const Scene scene = make_scene(parameters);

  require(0 < scene.inner_radius && scene.inner_radius < scene.outer_radius, "0 < a < b");
  require(scene.zone_begin < scene.zone_end, "z0 < z1");
  const double middle = (scene.zone_begin + scene.zone_end) / 2;
  require(std::isfinite(scene.phi(middle)), "the road is finite");
  if (scene.force)
    require(!std::isnan(scene.force(scene.outer_radius, middle)) || !scene.force.uniform,
            "a uniform force is a number");

  const std::string text_of_parameters = printed(settings);
  const std::vector<Setting> again = parse_settings(text_of_parameters, "input");
  require(printed(again) == text_of_parameters, "printed parameters are read back",
          text_of_parameters);
}

void require_readable(const std::string& message) {
  require(!message.empty(), "a refusal has a message");
  require(message.size() < 8192, "a message is short", message);
  require(std::none_of(message.begin(), message.end(),
                       [](unsigned char c) { return std::iscntrl(c) && c != '\n'; }),
          "a message has no control characters", message);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    read(std::string(data, data + size));
  } catch (const BadInput& refusal) {
    require_readable(refusal.what());
  }
  return 0;
}
