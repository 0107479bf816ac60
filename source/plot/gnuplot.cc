#include "rollwave/plot/gnuplot.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/text.h"

#include <boost/algorithm/string/replace.hpp>
#include <deal.II/base/timer.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <string>

namespace rollwave {

namespace fs = std::filesystem;

namespace {

/// Runs a command of the shell. Returns true if it succeeds. @param messages what it prints
bool run_shell(const std::string& command, std::string& messages) {
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (!pipe)
    return false;
  std::array<char, 4096> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe))
    messages += buffer.data();
  return pclose(pipe) == 0;
}

} // namespace

std::string in_single_quotes(const std::string& text) {
  std::string line = boost::algorithm::replace_all_copy(text, "'", "''");
  for (char& letter : line)
    if (std::iscntrl(static_cast<unsigned char>(letter)))
      letter = ' '; // the end of a line would end the string
  return '\'' + line + '\'';
}

std::vector<std::string> picture_files(const std::string& name) {
  return {name + ".gp", name + ".svg"};
}

void draw(const std::vector<Picture>& pictures, const fs::path& directory, WrittenFiles& written) {
  for (const auto& [name, script, width, height] : pictures)
    written.write(directory / (name + ".gp"),
                  "# gnuplot " + name + ".gp draws " + name +
                      ".svg\nif (!exists('picture')) picture = '" + name +
                      ".svg'\nset terminal svg noenhanced size " + std::to_string(width) + ',' +
                      std::to_string(height) +
                      " font 'Helvetica,14' background rgb 'white' fixed\nset output picture\n" +
                      script + "set output\n");
  const std::string change_directory =
      "cd '" + boost::algorithm::replace_all_copy(fs::absolute(directory).string(), "'", "'\\''") +
      "' && exec timeout -k 1 ";
  const dealii::Timer timer;
  for (const Picture& picture : pictures) {
    const std::string script = picture.name + ".gp", svg = picture.name + ".svg";
    AtomicFile file(directory / svg);
    std::string messages;
    constexpr double most_seconds = 60; // for all pictures: gnuplot may wait for ever
    const double left = std::max(most_seconds - timer.wall_time(), 0.1);
    if (run_shell(change_directory + std::to_string(left) + " gnuplot -d -e \"picture='" +
                      file.part().filename().string() + "'\" " + script + " 2>&1",
                  messages)) {
      if (read_file(file.part()).find("</svg>") == std::string::npos) // which gnuplot passes over
        throw NotWritten((directory / svg).string() + " could not be written as a whole: the disk "
                                                      "is full, or the size of files is limited");
      written.n_bytes += file.commit();
      written.files.push_back(directory / svg);
    } else
      written.remarks.push_back(svg + " was not drawn: gnuplot has " +
                                (timer.wall_time() > most_seconds
                                     ? "taken more than a minute"
                                     : "failed: " + printable(trimmed(messages))) +
                                "; its script is " + script);
  }
}

} // namespace rollwave
