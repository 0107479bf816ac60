#include "gnuplot.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <unistd.h>

namespace rollwave {

namespace {

/// A temporary file that vanishes with this object.
class TemporaryFile {
public:
  TemporaryFile() {
    const char* const directory = std::getenv("TMPDIR");
    name = std::string(directory ? directory : "/tmp") + "/rollwave-XXXXXX";
    descriptor = mkstemp(name.data());
  }
  ~TemporaryFile() {
    if (descriptor >= 0) {
      close(descriptor);
      unlink(name.c_str());
    }
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  bool write(const std::string& content) const {
    return descriptor >= 0 && ::write(descriptor, content.data(), content.size()) ==
                                  static_cast<ssize_t>(content.size());
  }

  std::string name;

private:
  int descriptor;
};

} // namespace

std::optional<std::string> draw_svg(const std::string& script, unsigned int width,
                                    unsigned int height) {
  const TemporaryFile file;
  if (!file.write("set terminal svg size " + std::to_string(width) + "," + std::to_string(height) +
                  " font 'Helvetica,14' background rgb 'white' dynamic\n" + script))
    return {};
  FILE* const pipe = popen(("gnuplot '" + file.name + "' 2>/dev/null").c_str(), "r");
  if (!pipe)
    return {};
  std::string svg;
  std::array<char, 65536> buffer;
  std::size_t count = 0;
  while ((count = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0)
    svg.append(buffer.data(), count);
  if (pclose(pipe) != 0 || svg.empty())
    return {};
  return svg;
}

} // namespace rollwave
