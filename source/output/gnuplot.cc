#include "rollwave/output/gnuplot.h"

#include "rollwave/base/text.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <sys/mman.h>

namespace rollwave {

namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

/// A file in memory, which needs no directory that can be written; empty where there can be none.
File open_in_memory(const std::string& content) {
  const int descriptor = memfd_create("rollwave", 0);
  File file(descriptor < 0 ? nullptr : fdopen(descriptor, "w+"));
  if (file && (std::fputs(content.c_str(), file.get()) < 0 || std::fflush(file.get()) != 0))
    file.reset();
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

Picture draw(const std::string& script, unsigned int width, unsigned int height) {
  const File commands = open_in_memory(
      "set terminal svg noenhanced size " + std::to_string(width) + "," + std::to_string(height) +
      " font 'Helvetica,14' background rgb 'white' fixed\n" + script);
  const File messages = open_in_memory("");
  std::FILE* pipe = nullptr;
  // An interrupt is for this program, which still wants the picture of what it has.
  if (commands && messages)
    pipe = popen(("trap '' INT TERM HUP USR1 USR2 XCPU; exec gnuplot -d " +
                  path_of(commands.get()) + " 2>" + path_of(messages.get()))
                     .c_str(),
                 "r");
  if (!pipe)
    return {"", std::string("gnuplot cannot be started: ") + std::strerror(errno)};
  const std::string svg = read_all(pipe);
  if (pclose(pipe) == 0 && !svg.empty())
    return {svg, ""};
  std::rewind(messages.get());
  return {"", "gnuplot has failed: " + printable(trimmed(read_all(messages.get())))};
}

} // namespace rollwave
