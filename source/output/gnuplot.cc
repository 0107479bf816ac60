#include "rollwave/output/gnuplot.h"

#include <array>
#include <cstdlib>
#include <fcntl.h>
#include <unistd.h>

namespace rollwave {

namespace {

/// A temporary file without a name, which vanishes with the last process that has it open, however
/// that ends.
class TemporaryFile {
public:
  TemporaryFile() {
    const char* const directory = std::getenv("TMPDIR");
    std::string name = std::string(directory ? directory : "/tmp") + "/rollwave-XXXXXX";
    descriptor = mkstemp(name.data());
    if (descriptor >= 0)
      unlink(name.c_str());
  }
  ~TemporaryFile() {
    if (descriptor >= 0)
      close(descriptor);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  bool write(const std::string& content) const {
    return descriptor >= 0 && ::write(descriptor, content.data(), content.size()) ==
                                  static_cast<ssize_t>(content.size());
  }

  /// Where processes that this one starts find it.
  std::string path() const { return "/dev/fd/" + std::to_string(descriptor); }

private:
  int descriptor;
};

} // namespace

Drawing::Drawing(const std::string& script, unsigned int width, unsigned int height) {
  const TemporaryFile file;
  if (file.write("set terminal svg noenhanced size " + std::to_string(width) + "," +
                 std::to_string(height) + " font 'Helvetica,14' background rgb 'white' fixed\n" +
                 script))
    // An interrupt is for this program, which still wants the picture of what it has.
    pipe.reset(
        popen(("trap '' INT TERM; exec gnuplot -d " + file.path() + " 2>/dev/null").c_str(), "r"));
  // A full pipe would hold gnuplot up; a file instead could be cut short where the disk is full,
  // which gnuplot does not tell.
  constexpr int most_without_privilege = 1 << 20;
  if (pipe)
    fcntl(fileno(pipe.get()), F_SETPIPE_SZ, most_without_privilege);
}

std::optional<std::string> Drawing::take_svg() {
  if (!pipe)
    return {};
  std::string svg;
  std::array<char, 65536> buffer;
  std::size_t count = 0;
  while ((count = std::fread(buffer.data(), 1, buffer.size(), pipe.get())) > 0)
    svg.append(buffer.data(), count);
  if (pclose(pipe.release()) != 0 || svg.empty())
    return {};
  return svg;
}

} // namespace rollwave
