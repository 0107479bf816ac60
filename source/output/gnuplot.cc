#include "rollwave/output/gnuplot.h"

#include "rollwave/base/text.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/mman.h>

namespace rollwave {

namespace {

/// A file in memory, which needs no directory that can be written; nullptr where there can be none.
std::FILE* open_in_memory(const std::string& content) {
  const int descriptor = memfd_create("rollwave", 0);
  std::FILE* const file = descriptor < 0 ? nullptr : fdopen(descriptor, "w+");
  if (file && (std::fputs(content.c_str(), file) < 0 || std::fflush(file) != 0)) {
    std::fclose(file);
    return nullptr;
  }
  return file;
}

/// Where processes that this one starts find a file that it has open.
std::string path_of(std::FILE* file) {
  return "/dev/fd/" + std::to_string(fileno(file));
}

std::string read_all(std::FILE* file) {
  std::string text;
  std::array<char, 65536> buffer;
  std::size_t count = 0;
  while ((count = std::fread(buffer.data(), 1, buffer.size(), file)) > 0)
    text.append(buffer.data(), count);
  return text;
}

} // namespace

Drawing::Drawing(const std::string& script, unsigned int width, unsigned int height) {
  const std::unique_ptr<std::FILE, Close> commands(open_in_memory(
      "set terminal svg noenhanced size " + std::to_string(width) + "," + std::to_string(height) +
      " font 'Helvetica,14' background rgb 'white' fixed\n" + script));
  if (commands)
    messages.reset(open_in_memory(""));
  // An interrupt is for this program, which still wants the picture of what it has.
  if (messages)
    pipe.reset(popen(("trap '' INT TERM HUP USR1 USR2 XCPU; exec gnuplot -d " +
                      path_of(commands.get()) + " 2>" + path_of(messages.get()))
                         .c_str(),
                     "r"));
  if (!pipe) {
    failure = std::strerror(errno);
    return;
  }
  // A full pipe would hold gnuplot up; a file instead could be cut short where the disk is full,
  // which gnuplot does not tell.
  constexpr int most_without_privilege = 1 << 20;
  fcntl(fileno(pipe.get()), F_SETPIPE_SZ, most_without_privilege);
}

Picture Drawing::take() {
  if (!pipe)
    return {"", "gnuplot cannot be started: " + failure};
  const std::string svg = read_all(pipe.get());
  if (pclose(pipe.release()) == 0 && !svg.empty())
    return {svg, ""};
  std::rewind(messages.get());
  return {"", "gnuplot has failed: " + printable(trimmed(read_all(messages.get())))};
}

} // namespace rollwave
