#include "rollwave/output/gnuplot.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/text.h"

#include <boost/algorithm/string/replace.hpp>

#include <array>
#include <cctype>
#include <cstdio>

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

/// False for a picture that was cut short, as on a full disk, which gnuplot does not report.
bool is_complete(const fs::path& svg) {
  return read_file(svg).find("</svg>") != std::string::npos;
}

} // namespace

std::string in_single_quotes(const std::string& text) {
  std::string line = boost::algorithm::replace_all_copy(text, "'", "''");
  for (char& letter : line)
    if (std::iscntrl(static_cast<unsigned char>(letter)))
      letter = ' '; // the end of a line would end the string
  return '\'' + line + '\'';
}

void draw(const Picture& picture, const fs::path& directory, const std::string& name,
          WrittenFiles& written) {
  const std::string script = name + ".gp", svg = name + ".svg";
  written.write(directory / script,
                "# gnuplot " + script + " draws " + svg + "\nif (!exists('picture')) picture = '" +
                    svg + "'\nset terminal svg noenhanced size " + std::to_string(picture.width) +
                    ',' + std::to_string(picture.height) +
                    " font 'Helvetica,14' background rgb 'white' fixed\nset encoding utf8\n"
                    "set output picture\n" +
                    picture.script + "set output\n");
  AtomicFile file(directory / svg);
  std::string messages;
  if (run_shell(
          "cd '" +
              boost::algorithm::replace_all_copy(fs::absolute(directory).string(), "'", "'\\''") +
              "' && exec gnuplot -d -e \"picture='" + file.part().filename().string() + "'\" " +
              script + " 2>&1",
          messages) &&
      is_complete(file.part())) {
    written.n_bytes += file.commit();
    written.files.push_back(directory / svg);
  } else {
    std::error_code ignored;
    fs::remove(directory / svg, ignored); // it would be that of an earlier run
    written.remarks.push_back(svg + " was not drawn: gnuplot has failed: " +
                              printable(trimmed(messages)) + "; its script is " + script);
  }
}

} // namespace rollwave
