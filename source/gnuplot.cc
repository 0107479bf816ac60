#include "gnuplot.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <unistd.h>
#include <utility>

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

  /// What is in the file, from its begin.
  std::string content() const {
    std::string text;
    std::array<char, 65536> buffer;
    ssize_t count = 0;
    while ((count = pread(descriptor, buffer.data(), buffer.size(), text.size())) > 0)
      text.append(buffer.data(), count);
    return text;
  }

  /// Where processes that this one starts find it.
  std::string path() const { return "/dev/fd/" + std::to_string(descriptor); }

private:
  int descriptor;
};

} // namespace

/// A pipe for the picture would hold gnuplot up when full.
struct Drawing::Process {
  TemporaryFile script, svg;
  std::FILE* pipe = nullptr;

  /// Whether gnuplot has drawn, when it has ended.
  bool end() { return pipe && pclose(std::exchange(pipe, nullptr)) == 0; }
};

void Drawing::End::operator()(Process* process) const {
  process->end();
  delete process;
}

Drawing::Drawing(const std::string& script, unsigned int width, unsigned int height)
    : process(new Process) {
  if (process->script.write("set terminal svg size " + std::to_string(width) + "," +
                            std::to_string(height) +
                            " font 'Helvetica,14' background rgb 'white' dynamic\n" + script))
    // An interrupt is for this program, which still wants the picture of what it has.
    process->pipe = popen(("trap '' INT TERM; exec gnuplot " + process->script.path() + " >" +
                           process->svg.path() + " 2>/dev/null")
                              .c_str(),
                          "r");
}

std::optional<std::string> Drawing::take_svg() {
  if (!process->end())
    return {};
  std::string svg = process->svg.content();
  if (svg.empty())
    return {};
  return svg;
}

} // namespace rollwave
